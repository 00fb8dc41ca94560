// SPDX-License-Identifier: GPL-3.0-or-later
// Target: JSON files that report, compare and info read, tables of results and verifications.
#include "pipeline/experiments/verification/verification.h"
#include "pipeline/process/result_table.h"
#include "tests/reliability/fuzz/input_folder.h"

using namespace flexneck;

namespace {

/// Checks that the tables are the same after writing and reading.
void check(const pipeline::TableFile& file, const std::filesystem::path& copy) {
  for (const pipeline::ResultTable& table : file.tables) {
    for (const auto& row : table.rows)
      fuzz::require(row.size() == table.columns.size(), "a row has a cell for each column");
    fuzz::require(pipeline::printed(table).starts_with(table.title), "a table is printed");
  }
  pipeline::write_tables(copy, file.tables, file.provenance);
  const pipeline::TableFile again = pipeline::read_tables(copy);
  fuzz::require(again.tables.size() == file.tables.size(), "tables are written and read");
  for (std::size_t k = 0; k < again.tables.size(); ++k)
    fuzz::require(again.tables[k].rows == file.tables[k].rows, "rows are written and read");
}

void check(const pipeline::VerificationFile& file, const std::filesystem::path& copy) {
  pipeline::write_verification(copy, file.table, file.provenance);
  const pipeline::VerificationTable again = pipeline::read_verification(copy).table;
  fuzz::require(again.rows.size() == file.table.rows.size(), "rows are written and read");
  fuzz::require(again.passed() == file.table.passed(), "the verdict is written and read");
  fuzz::require(!pipeline::printed(again).empty(), "a verification is printed");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::InputFolder folder;
  const std::filesystem::path path = folder.with("results.json", fuzz::text_of(data, size));
  const std::filesystem::path copy = folder.path() / "copy.json";
  const bool holds = pipeline::holds_tables(path);
  fuzz::try_reader([&] {
    const pipeline::TableFile file = pipeline::read_tables(path);
    fuzz::require(holds, "what is read as tables says that it holds them");
    check(file, copy);
  });
  return fuzz::try_reader([&] { check(pipeline::read_verification(path), copy); });
}
