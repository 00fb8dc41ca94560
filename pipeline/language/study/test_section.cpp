// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/foundation/names.h"
#include "pipeline/language/model/model_sections.h"
#include "pipeline/language/study/regulation.h"
#include "pipeline/language/study/sections.h"

namespace flexneck::pipeline {

namespace {

constexpr Key kDummyKeys[] = {
    Key::text("name", kRequired,
              "Name of the dummy; tests for other dummies are reported as not applicable"),
};

constexpr Key kTestKeys[] = {
    Key::text("name", kRequired, "Name of the test"),
    Key::text("regulation", kNone,
              "Test of a regulation whose limits apply, such as \"572.33 flexion\"; in addition to "
              "or instead of measured data"),
    Key::file("file", kNone, "File with the regulation (default: the shipped ones)"),
    Key::text("case", kRequired, "Case that is evaluated; a regulation requires a pendulum case"),
};

/// Rules of a test.
/// @param known  tests of an earlier reading, whose files need not be read again
ShippedTest rules_of(const StudyTable& table, const std::string& test_name,
                     const std::vector<TestSection>& known) {
  const std::string name = table.text("regulation");
  const bool has_file = table.has("file");
  for (const TestSection& each : known)
    if (each.name == test_name && each.rules.name == name &&
        (!has_file || each.file == table.file("file"))) {
      note_reads(each.reads);
      return {each.rules, each.file};
    }
  if (!has_file) return at_key(table, "regulation", [&] { return shipped_test(name); });
  const std::filesystem::path file = table.file("file");
  const std::vector<CertificationTest> tests = read_regulation(file);
  return at_key(table, "regulation", [&] {
    return ShippedTest{tests[find_name(names_of(tests), name, "test in " + file.string())], file};
  });
}

void check_direction(const StudyTable& table, const Study& study, const TestSection& test) {
  const CaseSection& experiment =
      study.cases[find_name(names_of(study.cases), test.experiment, "case")];
  const auto wanted = test.rules.direction == CertificationTest::Direction::flexion
                          ? CaseSection::Direction::flexion
                          : CaseSection::Direction::extension;
  if (experiment.kind != CaseSection::Kind::pendulum || experiment.direction != wanted)
    table.refuse("case", "expected a case of the pendulum in the direction of '" + test.rules.name +
                             "', found '" + test.experiment + "'");
}

/// Reads a test of a regulation.
void read_certification(const StudyTable& table, const std::vector<TestSection>& known,
                        Study& study) {
  TestSection test;
  test.name = table.text("name");
  const FilesRead reads;
  auto [rules, file] = rules_of(table, test.name, known);
  test.reads = reads.files();
  test.rules = std::move(rules);
  test.file = std::move(file);
  test.experiment = table.text("case");
  check_direction(table, study, test);
  if (study.dummy.empty())
    table.refuse("regulation",
                 "expected [dummy] with a name, which is compared with the dummy of the "
                 "regulation, found none");
  study.tests.push_back(std::move(test));
}

void read_test(const StudyTable& table, const std::vector<TestSection>& known, Study& study) {
  const std::string experiment = table.text("case");
  at_key(table, "case", [&] { return find_name(names_of(study.cases), experiment, "case"); });
  MeasuredTest measured = read_measured(table);
  measured.name = table.text("name");
  measured.experiment = experiment;
  if (table.has("regulation"))
    read_certification(table, known, study);
  else if (measured.is_empty())
    table.refuse("regulation",
                 "expected this key, or [[test.curve]], [[test.corridor]] or "
                 "[[test.limit]]");
  if (!measured.is_empty()) study.measured.push_back(std::move(measured));
}

}  // namespace

std::span<const Key> dummy_keys() { return kDummyKeys; }

std::span<const Key> test_keys() {
  static const std::vector<Key> keys = [] {
    std::vector<Key> all(std::begin(kTestKeys), std::end(kTestKeys));
    all.insert(all.end(), measured_keys().begin(), measured_keys().end());
    return all;
  }();
  return keys;
}

void read_tests(const StudyTable& root, const std::vector<TestSection>& known, CasesRead which,
                Study& study) {
  if (root.has("dummy")) {
    const StudyTable dummy = root.table("dummy");
    study.dummy = dummy.text("name");
    dummy.finish();
  }
  const std::set<std::string> chosen = chosen_cases(root, study.cases);
  std::vector<std::string> names;
  for (const StudyTable& table : root.tables("test")) {
    if (which == CasesRead::chosen && !chosen.contains(table.text("case"))) continue;
    names.push_back(table.text("name"));
    read_test(table, known, study);
    table.finish();
  }
  check_names(names, "test");
}

}  // namespace flexneck::pipeline
