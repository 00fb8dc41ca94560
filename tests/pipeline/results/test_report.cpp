// SPDX-License-Identifier: GPL-3.0-or-later
#include <fstream>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/foundation/error.h"
#include "geometry/foundation/input_file.h"
#include "geometry/foundation/temporary_folder.h"
#include "pipeline/results/plotting/embedding.h"
#include "pipeline/results/report/comparison.h"
#include "pipeline/results/report/display_units.h"
#include "pipeline/run/results_folder.h"
#include "tests/pipeline/results/report_page.h"

using namespace flexneck;
using namespace flexneck::pipeline;
using Catch::Matchers::Contains;
using testing::built_in;
using testing::joined;
using testing::page_of;
using testing::small_run;

namespace {

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
  write_tables(folder / kComparisonTables, {small_table()}, made_by("two"));  // tables of other
                                                                              // folders
  multibody::HistoryFile other = small_run(3);
  other.provenance.parameters.front().value = "another dimension";
  multibody::write_history(folder / "pendulum-flexion-60.h5", other);

  const Results results = read_results(folder.path(), built_in());
  CHECK(results.tables.size() == 2);
  CHECK(results.find(Experiment::Kind::pendulum, "flexion-60") != nullptr);
  const std::string warnings = joined(results.warnings);
  CHECK_THAT(warnings, Contains("mesh.h5") && Contains("verification.json") &&
                           Contains("'a' has a row of 1 cells for 0 columns") &&
                           Contains("different versions") && Contains("(one)") &&
                           Contains("another dimension"));
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
  CHECK_THAT(page, Contains("Figure 11.") && Contains("Not drawn, since this is missing:"));
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
  // The section comes after the first screen, which summarises it.
  CHECK(page.find("<section ") == page.find("<section id=\"view\""));
  CHECK(page.find("<section ", page.find("<section ") + 1) == certification);
  const std::string first_screen = page.substr(0, certification);
  CHECK_THAT(first_screen, Contains("✗</span> FAIL</span>") && Contains("✓</span> pass</span>"));
  CHECK(page.find("data-table=\"verdicts\"") == page.rfind("data-table=\"verdicts\""));
  CHECK_THAT(page, Contains("✗</span> FAIL</span>") && Contains("✓</span> pass</span>") &&
                       Contains("extension &lt;b&gt;") && Contains("Warning: pulse at 10 ms"));
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
