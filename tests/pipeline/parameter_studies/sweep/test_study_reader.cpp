// SPDX-License-Identifier: GPL-3.0-or-later
// A study read again with other values, against one read from scratch.
#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "pipeline/language/study/study_reader.h"

using namespace flexneck;
using namespace flexneck::pipeline;

namespace {

/// Text of parameters without tests and cases: those that are not chosen are not recorded again.
std::string text_of(const std::vector<Parameter>& parameters) {
  std::string text;
  for (const Parameter& each : parameters)
    if (!each.key.starts_with("test.") && !each.key.starts_with("case."))
      text += each.key + "=" + each.value + " " + std::string(name_of(each.origin)) + "\n";
  return text;
}

double damping_ratio(const Study& study) {
  return study.model.of_structure.begin()->second.damping_ratio.value();
}

void check_same(const Study& a, const Study& b) {
  CHECK(text_of(a.parameters) == text_of(b.parameters));
  CHECK(text_of(a.defaults) == text_of(b.defaults));
  CHECK(a.settings == b.settings);
  CHECK(damping_ratio(a) == damping_ratio(b));
}

}  // namespace

TEST_CASE("a study that is read again with other values is the one that is read anew") {
  const std::vector<std::string> base = {"modes.count=6"};
  StudyReader reader(built_in_study(), base);
  for (const char* const value : {"0.7", "0.8", "0.7"}) {
    const std::string damping = std::string("body.neck.damping_ratio=") + value;
    const std::string duration = std::string("case.flexion-60.duration=\"") + value + " s\"";
    check_same(reader.read({damping, duration}),
               read_study(built_in_study(), {base[0], damping, duration}));
  }
  // With other keys, or none, those of the reading before have no effect.
  check_same(reader.read({"solver.relative_tolerance=1e-7"}),
             read_study(built_in_study(), {base[0], "solver.relative_tolerance=1e-7"}));
  check_same(reader.read({}), read_study(built_in_study(), base));
}

TEST_CASE("a study that is read again leaves out the models of cases that it does not choose") {
  const std::vector<std::string> other = {"variables.relaxation_time=9 ms"};
  const auto durations = [](const Study& study) {
    std::vector<double> values;
    for (const CaseSection& each : study.cases) {
      values.push_back(each.duration_s);
      CHECK(each.model.model.bodies.size() == 7);
    }
    return values;
  };
  StudyReader reader(built_in_qualification(), {});
  const Study again = reader.read(other);
  const Study anew = read_study(built_in_qualification(), other);
  CHECK(durations(again) == durations(anew));
  REQUIRE(again.tests.size() == anew.tests.size());
  for (std::size_t k = 0; k < anew.tests.size(); ++k) {
    CHECK(again.tests[k].name == anew.tests[k].name);
    CHECK(again.tests[k].rules.name == anew.tests[k].rules.name);
    CHECK(again.tests[k].file == anew.tests[k].file);
  }
  CHECK_NOTHROW(reader.read({"case.flexion-20.bodies=[\"no such body\"]"}));
  CHECK_THROWS_AS(reader.read({"case.certification-flexion.bodies=[\"no such body\"]"}),
                  InputError);
}

TEST_CASE("a value that is refused does not stay for the next reading") {
  StudyReader reader(built_in_study(), {});
  REQUIRE(damping_ratio(reader.read({"body.neck.damping_ratio=0.7"})) == 0.7);
  CHECK_THROWS_AS(reader.read({"body.neck.damping_ratio=much"}), InputError);
  CHECK(damping_ratio(reader.read({"body.neck.damping_ratio=0.6"})) == 0.6);
  CHECK_THROWS_AS(reader.read({"body.nack.damping_ratio=1"}), InputError);
}
