// SPDX-License-Identifier: GPL-3.0-or-later
// Target: values set on the command line, one per line, for a study of a few keys.
#include <sstream>

#include "pipeline/language/document/study_document.h"
#include "tests/reliability/fuzz/input_folder.h"

using namespace flexneck;

namespace {

constexpr const char* kStudy = R"(
[solver]
gravity = ["0 gn", "0 gn", "-1 gn"]
[modes]
count = { value = 3, origin = "published", note = "three" }
fixed = ["clamp"]
[[body]]
name = "head"
mass = "1 kg"
[[body]]
name = "base"
mass = "2 kg"
)";

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

using pipeline::Key;
using pipeline::KeyType;

constexpr Key kSolverKeys[] = {
    Key::quantities("gravity", "m/s^2", "", "", {.size = 3}),
    Key::quantity("end_time", "s", "1", ""),
    Key::number("*", "", ""),
};
constexpr Key kModesKeys[] = {
    Key::count("count", "3", ""),
    Key::texts("held", "-", ""),
    Key::flag("check", "false", ""),
    Key::numbers("*", "", ""),
};
constexpr Key kBodyKeys[] = {
    Key::text("name", "", ""),
    Key::quantity("mass", "kg", "", ""),
    Key::text("*", "", ""),
};
extern const Key kKeys[4];  // a table in itself
const Key kKeys[4] = {
    Key::table("solver", "", kSolverKeys),
    Key::table("modes", "", kModesKeys),
    Key::tables("body", "", kBodyKeys),
    Key::table("*", "", kKeys),
};

void read_all(const pipeline::StudyTable& table, int depth);

/// Reads a value with the type of its row.
void read(const pipeline::StudyTable& table, const std::string& key, int depth) {
  switch (pipeline::find_key(table.key_rows(), key)->type) {
    case KeyType::quantities:
      static_cast<void>(table.quantities(key));
      break;
    case KeyType::quantity:
      static_cast<void>(table.quantity(key));
      break;
    case KeyType::number:
      static_cast<void>(table.number(key));
      break;
    case KeyType::numbers:
      static_cast<void>(table.numbers(key));
      break;
    case KeyType::count:
      static_cast<void>(table.count(key));
      break;
    case KeyType::texts:
      static_cast<void>(table.texts(key));
      break;
    case KeyType::flag:
      static_cast<void>(table.flag(key));
      break;
    case KeyType::tables:
      for (const pipeline::StudyTable& each : table.tables(key)) read_all(each, depth + 1);
      break;
    case KeyType::table:
      read_all(table.table(key), depth + 1);
      break;
    default:
      static_cast<void>(table.text(key));
  }
}

void read_all(const pipeline::StudyTable& table, int depth) {
  fuzz::require(depth < 40, "tables nest as deep as is allowed");
  for (const std::string& key : table.keys()) fuzz::try_reader([&] { read(table, key, depth); });
  table.finish();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::InputFolder folder;
  static const std::filesystem::path study = folder.with("study.toml", kStudy);
  return fuzz::try_reader([&] {
    const pipeline::StudyDocument document(study, lines_of(fuzz::text_of(data, size)), kKeys);
    read_all(document.root(), 0);
  });
}
