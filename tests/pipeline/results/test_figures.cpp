// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdlib>
#include <fstream>
#include <optional>
#include <set>

#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "geometry/foundation/temporary_folder.h"
#include "pipeline/results/plotting/curve_figure.h"
#include "tests/pipeline/results/report_page.h"

using namespace flexneck;
using namespace flexneck::pipeline;
using Catch::Matchers::Contains;
using testing::page_of;
using testing::small_run;

namespace {

namespace fs = std::filesystem;

/// Sets a variable of the environment during its scope.
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

}  // namespace

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
