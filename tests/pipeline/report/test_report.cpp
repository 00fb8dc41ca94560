// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdlib>
#include <fstream>
#include <optional>
#include <set>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/foundation/error.h"
#include "geometry/foundation/input_file.h"
#include "geometry/foundation/temporary_folder.h"
#include "multibody/files/history_file.h"
#include "pipeline/experiments/pendulum_tables.h"
#include "pipeline/folder/results_folder.h"
#include "pipeline/plotting/curve_figure.h"
#include "pipeline/plotting/embedding.h"
#include "pipeline/report/comparison.h"
#include "pipeline/report/corridors.h"
#include "pipeline/report/display_units.h"
#include "pipeline/report/paper_context.h"
#include "pipeline/report/report.h"
#include "pipeline/report/results.h"

using namespace flexneck;
using namespace flexneck::pipeline;
using Catch::Matchers::Contains;

namespace {

namespace fs = std::filesystem;

const Study& built_in() {
  static const Study study = read_study(built_in_study(), {});
  return study;
}

/// A run of the pendulum with two channels and nothing else.
multibody::HistoryFile small_run(int samples) {
  multibody::HistoryFile file;
  file.history.time_s = Eigen::VectorXd::LinSpaced(samples, 0, 0.01 * (samples - 1));
  for (Eigen::VectorXd* energy :
       {&file.history.energy.kinetic_J, &file.history.energy.gravitational_J,
        &file.history.energy.strain_J, &file.history.energy.dissipated_J,
        &file.history.energy.work_J, &file.history.constraints.position_m,
        &file.history.constraints.orientation_rad, &file.history.constraints.velocity_m_s,
        &file.history.constraints.angular_velocity_rad_s}) {
    *energy = Eigen::VectorXd::Zero(samples);
  }
  const Eigen::RowVectorXd ramp = file.history.time_s.transpose();
  file.channels = {{"head rotation", "rad", {"angle"}, ramp, ""},
                   {"neck rotation", "rad", {"angle"}, 0.5 * ramp, ""}};
  file.provenance = provenance_of(built_in());
  return file;
}

ResultTable small_table() {
  ResultTable table;
  table.name = "peaks";
  table.title = "</script><img src=x onerror=alert(1)>";
  table.columns = {{"case", ""}, {"head rotation", "deg"}};
  table.rows = {{"flexion-60 <b>", "31.3"}};
  table.notes = {"a note with 'quotes' & <tags>"};
  return table;
}

Provenance made_by(const std::string& git_hash) { return {"flexneck 0.1.0", git_hash, {}, {}, {}}; }

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

std::string page_of(const fs::path& folder) {
  write_report(folder / "report.html", read_results(folder, built_in()), built_in());
  return text_of_file(folder / "report.html");
}

/// A variable of the environment for a while.
class Variable {
 public:
  Variable(const char* name, const std::string& value) : name_(name) {
    if (const char* const before = getenv(name)) before_ = before;
    setenv(name, value.c_str(), 1);
  }
  ~Variable() { before_ ? setenv(name_, before_->c_str(), 1) : unsetenv(name_); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* name_;
  std::optional<std::string> before_;
};

std::vector<std::string> paper_remarks() {
  return read_paper_remarks(fs::path(FLEXNECK_SOURCE_DIR) /
                            "pipeline/verification/hybrid3_context.toml");
}

}  // namespace

TEST_CASE("units are shown in two systems, by the factors of their definitions") {
  const auto metric = [](const std::string& unit) { return display_unit(unit)["metric"]; };
  CHECK(metric("lbf*ft")["factor"].get<double>() == Approx(4.4482216152605 * 0.3048));
  CHECK(metric("lbf*ft")["name"] == "N·m");
  CHECK(metric("in*lbf/deg")["factor"].get<double>() == Approx(4.4482216152605 * 0.0254));
  CHECK(metric("m")["factor"].get<double>() == Approx(1000));
  CHECK(metric("N")["factor"].get<double>() == Approx(1e-3));
  CHECK(display_unit("N*m", "in*lbf")["customary"]["factor"].get<double>() ==
        Approx(1 / (4.4482216152605 * 0.0254)));
  CHECK(display_unit("Hz").is_null());
  CHECK(unit_label("kg*m^2") == "kg·m²");
  CHECK(unit_label("gn") == "g");
  const nlohmann::ordered_json all = display_units();
  for (const auto& [unit, shown] : all.items()) {
    INFO(unit);
    for (const char* const system : {"customary", "metric"})
      CHECK(shown[system]["factor"].get<double>() > 0);
  }
}

TEST_CASE("names come in the order in which people count") {
  CHECK(comes_before("flexion-20", "flexion-60"));
  CHECK(comes_before("flexion-60", "flexion-120"));
  CHECK(comes_before("flexion-60", "flexion-60-rigid"));
  CHECK(comes_before("extension-120", "flexion-20"));
  CHECK_FALSE(comes_before("flexion-120", "flexion-60"));
  CHECK_FALSE(comes_before("flexion-60", "flexion-60"));
}

TEST_CASE("tables and verifications are read as they were written") {
  const TemporaryFolder folder;
  write_tables(folder / "tables.json", {small_table()}, made_by("abc"));
  CHECK(holds_tables(folder / "tables.json"));
  const TableFile file = read_tables(folder / "tables.json");
  REQUIRE(file.tables.size() == 1);
  CHECK(file.tables[0].title == small_table().title);
  CHECK(file.tables[0].rows == small_table().rows);
  CHECK(file.tables[0].notes == small_table().notes);
  CHECK(file.tables[0].columns[1].unit == "deg");
  CHECK(file.provenance.git_hash == "abc");

  VerificationTable table;
  VerificationRow row;
  row.quantity = "bending 1";
  row.value = "35.9";
  row.error_percent = -0.5;
  row.status = VerificationRow::Status::failed;
  row.fitted = true;
  table.rows = {row, VerificationRow()};
  write_verification(folder / "verification.json", table, made_by("abc"));
  CHECK_FALSE(holds_tables(folder / "verification.json"));
  const VerificationFile read = read_verification(folder / "verification.json");
  REQUIRE(read.table.rows.size() == 2);
  CHECK(read.table.rows[0].quantity == "bending 1");
  CHECK(read.table.rows[0].error_percent == row.error_percent);
  CHECK(read.table.rows[0].status == row.status);
  CHECK(read.table.rows[0].fitted);
  CHECK_FALSE(read.table.rows[1].error_percent);
}

TEST_CASE("files that cannot be trusted become warnings, files that are not there are named") {
  const TemporaryFolder folder;
  std::ofstream(folder / "mesh.h5") << "no HDF5";
  std::ofstream(folder / "verification.json") << R"({"format": "flexneck verification"})";
  std::ofstream(folder / "pendulum.json")
      << R"({"format": "flexneck tables", "format_version": 1, "provenance": {},
             "tables": [{"name": "a", "title": "", "columns": [], "rows": [["1"]], "notes": []}]})";
  write_tables(folder / "one.json", {small_table()}, made_by("one"));
  write_tables(folder / "two.json", {small_table()}, made_by("two"));
  multibody::HistoryFile other = small_run(3);
  other.provenance.parameters.front().value = "something else";
  multibody::write_history(folder / "pendulum-flexion-60.h5", other);

  const Results results = read_results(folder.path(), built_in());
  CHECK(results.tables.size() == 2);
  CHECK(results.find(Experiment::Kind::pendulum, "flexion-60") != nullptr);
  const std::string warnings = joined(results.warnings);
  CHECK_THAT(warnings, Contains("mesh.h5") && Contains("verification.json") &&
                           Contains("'a' has a row of 1 cells for 0 columns") &&
                           Contains("different versions") && Contains("(one)") &&
                           Contains("something else"));
  CHECK_THAT(joined(results.missing), Contains("modes.h5") && Contains("'flexneck modes'") &&
                                          Contains("pendulum-flexion-120.h5") &&
                                          !Contains("flexion-60.h5"));
}

TEST_CASE("the page stands by itself, shows what there is, and is the same each time") {
  const TemporaryFolder folder;
  write_tables(folder / "pendulum.json", {small_table()}, made_by("abc"));
  multibody::write_history(folder / "pendulum-flexion-60.h5", small_run(5));
  const std::string page = page_of(folder.path());
  CHECK_THAT(page, Contains("31.3") && Contains("flexion-60 &lt;b&gt;") &&
                       Contains("a note with &#39;quotes&#39; &amp; &lt;tags&gt;"));
  CHECK_THAT(page, !Contains("<img src=x") && !Contains("src=\"http") && !Contains("<link"));
  CHECK_THAT(page, Contains("default-src 'none'"));
  CHECK_THAT(page, !Contains(folder.path().string()));
  CHECK_THAT(page, Contains("Figure 11.") && Contains("Not drawn: there is not"));
  CHECK(page_of(folder.path()) == page);
}

TEST_CASE("verdicts of certification tests come first, each with a sign of its own") {
  const TemporaryFolder folder;
  CHECK_THAT(page_of(folder.path()), Contains("There are no verdicts in this folder yet"));

  ResultTable verdicts = small_table();
  verdicts.name = "verdicts";
  verdicts.columns = {{"test", ""}, {"verdict", ""}};
  verdicts.rows = {{"flexion", "FAIL"}, {"extension <b>", "pass"}};
  verdicts.notes = {"Warning: pulse at 10 ms"};
  write_tables(folder / "verdicts.json", {verdicts}, provenance_of(built_in()));
  const std::string page = page_of(folder.path());
  const std::size_t certification = page.find("<section id=\"certification\"");
  REQUIRE(certification != std::string::npos);
  // After the first screen, which has them in short.
  CHECK(page.find("<section ") == page.find("<section id=\"view\""));
  CHECK(page.find("<section ", page.find("<section ") + 1) == certification);
  const std::string first_screen = page.substr(0, certification);
  CHECK_THAT(first_screen, Contains("✗</span> FAIL</span>") && Contains("✓</span> pass</span>"));
  CHECK(page.find("data-table=\"verdicts\"") == page.rfind("data-table=\"verdicts\""));
  CHECK_THAT(page, Contains("✗</span> FAIL</span>") && Contains("✓</span> pass</span>") &&
                       Contains("extension &lt;b&gt;") && Contains("Warning: pulse at 10 ms"));
}

TEST_CASE("a figure's data are the channel's in the units of its axes") {
  const TemporaryFolder folder;
  multibody::write_history(folder / "pendulum-flexion-60.h5", small_run(3));
  page_of(folder.path());
  CHECK(text_of_file(folder / "figures/figure-11.csv") ==
        "\"time [ms]\",\"head rotation φ: rotation [deg]\",\"neck rotation φ′: rotation [deg]\"\n"
        "0,0,0\n"
        "10,0.572957795,0.286478898\n"
        "20,1.14591559,0.572957795\n");
  CHECK_THAT(text_of_file(folder / "figures/figure-11.svg"),
             Contains("No reference curve") && Contains("</svg>"));

  fs::remove(folder / "pendulum-flexion-60.h5");
  page_of(folder.path());
  CHECK_FALSE(fs::exists(folder / "figures/figure-11.svg"));
}

TEST_CASE("without gnuplot the package is named") {
  const TemporaryFolder folder;
  const Variable nothing_there("PATH", folder.path().string());
  CHECK_THROWS_WITH(page_of(folder.path()), Contains("gnuplot-nox"));
  CHECK_THROWS_AS(page_of(folder.path()), InputError);
}

TEST_CASE("gnuplot obeys the script alone, and no text in it") {
  CHECK(gnuplot_text("it's\nsystem(\"touch y\")\x1b") ==
        "'it''s\\nsystem(\"touch y\")\\x1b' noenhanced");
  const TemporaryFolder folder;
  std::ofstream(folder / ".gnuplot")
      << "system('touch \"" << (folder / "touched").string() << "\"')\n";
  const Variable home("HOME", folder.path().string());
  const Variable terminal("GNUTERM", "none such");
  multibody::write_history(folder / "pendulum-flexion-60.h5", small_run(3));
  page_of(folder.path());
  CHECK_FALSE(fs::exists(folder / "touched"));
}

TEST_CASE("each curve of a figure has a style of its own") {
  CurvePlot plot;
  for (int k = 0; k < 12; ++k)
    plot.curves.push_back({std::to_string(k), Eigen::Vector2d(0, 1), Eigen::Vector2d(0, k)});
  Figure figure{1};
  draw_curves(plot, figure);
  std::set<std::string> styles;
  const std::string before = "with lines ";
  for (std::size_t at = figure.script.find(before); at != std::string::npos;
       at = figure.script.find(before, at + 1)) {
    const std::size_t begin = at + before.size();
    styles.insert(figure.script.substr(begin, figure.script.find(" title", begin) - begin));
  }
  CHECK(styles.size() == plot.curves.size());
}

TEST_CASE("what the report says of pulses follows from their origins and from the corridors") {
  const Study& study = built_in();
  CHECK(joined(pulse_remarks(study)) ==
        "The pulse 'flexion' is synthetic by the study and, as given there, inside the corridor "
        "of 572.33 flexion. The table of velocities tells how cases scale it.\n"
        "The pulse 'extension' is synthetic by the study and, as given there, inside the corridor "
        "of 572.33 extension. The table of velocities tells how cases scale it.\n");
  CHECK_THAT(joined(peak_table(study, {}).notes),
             Contains("by the study: 'flexion' synthetic, 'extension' synthetic."));

  const TemporaryFolder folder;
  std::ofstream(folder / "mine.csv") << "time [ms], deceleration [gn]\n0, 0\n10, 20\n50, 0\n";
  std::ofstream(folder / "mine.toml")
      << "include = [\"" << built_in_study().string() << "\"]\n"
      << "[[pulse]]\nname = \"flexion\"\n"
         "table = { value = \"mine.csv\", origin = \"published\", note = \"a source\" }\n"
         "times = []\ndeceleration = []\n"
         "[[pulse]]\nname = \"extension\"\ntable = \"mine.csv\"\n"
         "times = []\ndeceleration = []\n";
  const Study own = read_study(folder / "mine.toml", {});
  const std::string remarks = joined(pulse_remarks(own));
  CHECK_THAT(remarks,
             Contains("'flexion' is published by the study and, as given there, outside") &&
                 !Contains("inside"));
  CHECK_THAT(joined(peak_table(own, {}).notes), Contains("'flexion' published"));
  CHECK_THAT(joined(paper_remarks()), !Contains("synthetic") && !Contains("inside"));
}

TEST_CASE("a pulse is inside of a corridor if it keeps to all of it") {
  CertificationTest test;
  test.pulse = DecelerationPulse{{0.01, 0.02}, {{20, 30}, {10, 20}}, 15, 5, {0.03, 0.04}};
  const auto is_in = [&](std::vector<double> times_s, std::vector<double> values) {
    return is_inside(PulseSection{"", std::move(times_s), std::move(values)}, test);
  };
  CHECK(is_in({0, 0.01, 0.02, 0.03, 0.04}, {0, 25, 15, 10, 0}));
  CHECK_FALSE(is_in({0, 0.01, 0.02, 0.03, 0.04}, {0, 31, 15, 10, 0}));
  CHECK_FALSE(is_in({0, 0.01, 0.02, 0.03, 0.04}, {0, 25, 9, 10, 0}));
  CHECK_FALSE(is_in({0, 0.01, 0.02, 0.03, 0.04}, {0, 25, 15, 16, 0}));  // too high after
  CHECK_FALSE(is_in({0, 0.01, 0.02, 0.025}, {0, 25, 15, 0}));           // falls too early
  CHECK_FALSE(is_in({0, 0.01, 0.02, 0.05}, {0, 25, 15, 6}));            // too late
  CHECK_FALSE(is_in({0, 0.005}, {25, 25}));
}

TEST_CASE("corridors stand behind the curves of the cases that are judged by them") {
  const auto corridors_at = [](const std::string& experiment, const std::string& channel,
                               const std::vector<std::string>& settings = {}) {
    std::vector<Corridor> found = corridors_of(read_study(built_in_study(), settings));
    std::erase_if(found, [&](const Corridor& corridor) {
      return corridor.experiment != experiment || corridor.channel != channel;
    });
    return found;
  };
  const double degree = std::numbers::pi / 180;
  const auto flexion = corridors_at("flexion-120", "head rotation");
  REQUIRE(flexion.size() == 2);
  CHECK(flexion[0].what == "572.33 flexion, peak rotation");
  CHECK(flexion[0].times_s.low == Approx(0.057));
  CHECK(flexion[0].times_s.high == Approx(0.064));
  CHECK(flexion[0].values.low == Approx(64 * degree));
  CHECK(flexion[0].values.high == Approx(78 * degree));
  CHECK(flexion[1].times_s.low == Approx(0.113));
  CHECK(flexion[1].values.high == 0);
  // The channel is negative in extension.
  const auto extension = corridors_at("extension-120-part572", "head rotation");
  REQUIRE(extension.size() == 2);
  CHECK(extension[0].values.low == Approx(-106 * degree));
  CHECK(extension[0].values.high == Approx(-81 * degree));
  const auto moment = corridors_at("extension-120-part572", "load cell moment");
  REQUIRE(moment.size() == 2);
  CHECK(moment[0].values.low == Approx(-59 * 1.3558179483));  // lbf ft
  // Neither at another velocity nor of another dummy.
  CHECK(corridors_at("flexion-120", "head rotation", {"case.flexion-120.impact_velocity=200 in/s"})
            .empty());
  CHECK(corridors_at("flexion-120", "head rotation", {"dummy.name=Hybrid III 5th female"}).empty());
}

TEST_CASE("names and notes of a user never become markup") {
  const TemporaryFolder folder;
  std::ofstream(folder / "<b>.toml")
      << "include = [\"" << built_in_study().string()
      << "\"]\ntest = []\n[geometry]\nplate_thickness = "
      << "{ value = \"0.4 in\", origin = \"published\", note = \"<script>alert(1)</script>\" }\n"
      << "[[pulse]]\nname = \"<img src=x>\"\n"
         "times = [\"0 s\", \"1 s\"]\ndeceleration = [\"1 gn\", \"1 gn\"]\n"
         "[pendulum]\npulse = \"<img src=x>\"\n[[case]]\nname = \"<b>case\"\n"
         "kind = \"pendulum\"\ndirection = \"flexion\"\nimpact_velocity = \"1 m/s\"\n"
         "[[variant]]\nname = \"<i>\"\nof = [\"<b>case\"]\n";
  const Study study = read_study(folder / "<b>.toml", {});
  multibody::HistoryFile run = small_run(3);
  run.channels[0].name = "<img src=x onerror=alert(2)>";
  run.channels[0].filter = "\xff";  // no UTF-8
  multibody::write_history(folder / "pendulum-<b>case.h5", run);
  write_report(folder / "report.html", read_results(folder.path(), study), study);
  const std::string page = text_of_file(folder / "report.html");
  CHECK_THAT(page, !Contains("<script>alert") && !Contains("<img src=x") && !Contains("<b>case") &&
                       !Contains("<small><b>"));
  CHECK_THAT(page, Contains("&lt;script&gt;alert(1)") && Contains("&lt;img src=x&gt;"));
}

TEST_CASE("studies side by side align by quantity and have their cases as the first one") {
  const auto study = [](const std::string& label, const std::string& first_bending) {
    ComparedStudy compared;
    compared.label = label;
    const auto row = [](const std::string& quantity, const std::string& detail) {
      VerificationRow made;
      made.quantity = quantity;
      made.detail = detail;
      made.unit = "Hz";
      made.value = "5.1";
      made.reference = "5";
      return made;
    };
    compared.results.verification =
        VerificationTable{{row("bending 1", first_bending), row("system frequency", "fore-aft"),
                           row("system frequency", "lateral")}};
    ResultTable peaks = small_table();
    peaks.rows = {{"flexion-60", "31"}, {"extension-60", "32"}};
    compared.results.tables = {peaks};
    for (const char* const name : {"extension-60", "flexion-60"})
      compared.results.experiments.push_back({Experiment::Kind::pendulum, name, small_run(3)});
    return compared;
  };
  const std::vector<ComparedStudy> studies = {study("one", "fore-aft bending 1"),
                                              study("two", "lateral bending 1")};
  const std::vector<ResultTable> tables = compared_tables(studies);
  REQUIRE(tables.size() == 4);
  CHECK(tables[1].rows ==
        std::vector<std::vector<std::string>>{
            {"bending 1; published 5 Hz", "5.1, fore-aft bending 1", "5.1, lateral bending 1"},
            {"system frequency, fore-aft; published 5 Hz", "5.1", "5.1"},
            {"system frequency, lateral; published 5 Hz", "5.1", "5.1"}});
  const TemporaryFolder folder;
  write_comparison(folder / "comparison.html", studies);
  const std::string page = text_of_file(folder / "comparison.html");
  std::size_t place = 0;
  for (const char* const run : {"flexion-60", "extension-60", "flexion-60-two", "extension-60-two"})
    place = page.find("\"name\":\"" + std::string(run) + "\"", place);
  CHECK(place != std::string::npos);
}
