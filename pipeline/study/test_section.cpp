// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/foundation/names.h"
#include "pipeline/model/model_sections.h"
#include "pipeline/study/sections.h"
#include "pipeline/verdict/regulation.h"

namespace flexneck::pipeline {

namespace {

constexpr Key kDummyKeys[] = {
    Key::text("name", kRequired,
              "Name of the dummy; tests of regulations for others do not apply to it"),
};

constexpr Key kTestKeys[] = {
    Key::text("name", kRequired, "Name of the test"),
    Key::text("regulation", kRequired, "Whose limits hold: such as \"572.33 flexion\""),
    Key::file("file", kNone, "File that the regulation stands in; without it those shipped"),
    Key::text("case", kRequired, "Case of the pendulum that is judged"),
};

/// @param known  of an earlier reading, whose files need not be read again
ShippedTest rules_of(const StudyTable& table, const std::string& test_name,
                     const std::vector<TestSection>& known) {
  const std::string name = table.text("regulation");
  const bool has_file = table.has("file");
  for (const TestSection& each : known)
    if (each.name == test_name && each.rules.name == name &&
        (!has_file || each.file == table.file("file")))
      return {each.rules, each.file};
  if (!has_file) return at_key(table, "regulation", [&] { return shipped_test(name); });
  const std::filesystem::path file = table.file("file");
  const std::vector<CertificationTest> tests = read_regulation(file);
  return at_key(table, "regulation", [&] {
    return ShippedTest{tests[find_name(names_of(tests), name, "test in " + file.string())], file};
  });
}

void check_case(const StudyTable& table, const Study& study, const TestSection& test) {
  const std::size_t place = at_key(
      table, "case", [&] { return find_name(names_of(study.cases), test.experiment, "case"); });
  const CaseSection& experiment = study.cases[place];
  const auto wanted = test.rules.direction == CertificationTest::Direction::flexion
                          ? CaseSection::Direction::flexion
                          : CaseSection::Direction::extension;
  if (experiment.kind != CaseSection::Kind::pendulum || experiment.direction != wanted)
    table.refuse("case", "expected a case of the pendulum in the direction of '" + test.rules.name +
                             "', found '" + test.experiment + "'");
}

}  // namespace

std::span<const Key> dummy_keys() { return kDummyKeys; }
std::span<const Key> test_keys() { return kTestKeys; }

void read_tests(const StudyTable& root, const std::vector<TestSection>& known, Study& study) {
  if (root.has("dummy")) {
    const StudyTable dummy = root.table("dummy");
    study.dummy = dummy.text("name");
    dummy.finish();
  }
  for (const StudyTable& table : root.tables("test")) {
    TestSection test;
    test.name = table.text("name");
    auto [rules, file] = rules_of(table, test.name, known);
    test.rules = std::move(rules);
    test.file = std::move(file);
    test.experiment = table.text("case");
    check_case(table, study, test);
    table.finish();
    if (study.dummy.empty())
      table.refuse("regulation",
                   "expected a [dummy] with a name, which the regulation is for or "
                   "not");
    study.tests.push_back(std::move(test));
  }
  check_names(names_of(study.tests), "test");
}

}  // namespace flexneck::pipeline
