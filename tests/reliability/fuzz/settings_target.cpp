// SPDX-License-Identifier: GPL-3.0-or-later
// Values set on the command line, one a line, over a study of a few keys.
#include <sstream>

#include "pipeline/document/study_document.h"
#include "tests/reliability/fuzz/input_folder.h"

using namespace flexneck;

namespace {

constexpr const char* kStudy = R"(
[solver]
gravity = ["0 gn", "0 gn", "-1 gn"]
[modes]
count = { value = 3, origin = "published", note = "three" }
held = ["clamp"]
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

/// Every value is asked for as each kind of thing.
void read_all(const pipeline::StudyTable& table, int depth) {
  fuzz::require(depth < 40, "tables nest as deep as is allowed");
  for (const std::string& key : table.keys()) {
    fuzz::try_reader([&] { static_cast<void>(table.text(key)); });
    fuzz::try_reader([&] { static_cast<void>(table.number(key)); });
    fuzz::try_reader([&] { static_cast<void>(table.count(key, 0)); });
    fuzz::try_reader([&] { static_cast<void>(table.quantities(key, "kg", 0)); });
    fuzz::try_reader([&] { static_cast<void>(table.texts(key)); });
    fuzz::try_reader([&] { read_all(table.table(key), depth + 1); });
    fuzz::try_reader([&] {
      for (const pipeline::StudyTable& each : table.tables(key)) read_all(each, depth + 1);
    });
  }
  table.finish();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::InputFolder folder;
  static const std::filesystem::path study = folder.with("study.toml", kStudy);
  return fuzz::try_reader([&] {
    const pipeline::StudyDocument document(study, lines_of(fuzz::text_of(data, size)));
    read_all(document.root(), 0);
  });
}
