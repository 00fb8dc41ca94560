// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdlib>
#include <fstream>

#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "geometry/foundation/temporary_folder.h"
#include "multibody/history_file.h"
#include "pipeline/report/comparison.h"
#include "pipeline/report/embedding.h"
#include "pipeline/report/report.h"
#include "pipeline/report/results.h"
#include "pipeline/results_folder.h"

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

/// The search path for a while.
class SearchPath {
 public:
  explicit SearchPath(const std::string& path) {
    if (const char* const before = getenv("PATH")) before_ = before;
    setenv("PATH", path.c_str(), 1);
  }
  ~SearchPath() { setenv("PATH", before_.c_str(), 1); }
  SearchPath(const SearchPath&) = delete;
  SearchPath& operator=(const SearchPath&) = delete;

 private:
  std::string before_;
};

}  // namespace

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
  const SearchPath nothing_there(folder.path().string());
  CHECK_THROWS_WITH(page_of(folder.path()), Contains("gnuplot-nox"));
  CHECK_THROWS_AS(page_of(folder.path()), InputError);
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
