// SPDX-License-Identifier: GPL-3.0-or-later
// Target: tables of comma-separated values. The first line may name the column after a #.
#include <algorithm>
#include <cmath>

#include "pipeline/language/model/csv_table.h"
#include "tests/reliability/fuzz/input_folder.h"

using namespace flexneck;

namespace {

void check(const pipeline::TableColumns& table) {
  const auto is_finite = [](double value) { return std::isfinite(value); };
  fuzz::require(!table.x.empty() && table.x.size() == table.y.size(), "columns have one length");
  fuzz::require(std::all_of(table.x.begin(), table.x.end(), is_finite), "x is finite");
  fuzz::require(std::all_of(table.y.begin(), table.y.end(), is_finite), "y is finite");
  fuzz::require(
      std::adjacent_find(table.x.begin(), table.x.end(), std::greater_equal<>()) == table.x.end(),
      "x increases strictly");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::InputFolder folder;
  const std::string text = fuzz::text_of(data, size);
  const std::string first = text.substr(0, text.find('\n'));
  const std::string column = first.starts_with('#') ? first.substr(1) : "";
  return fuzz::try_reader([&] {
    check(pipeline::read_csv_columns(folder.with("table.csv", text), "s", "m/s^2", column));
  });
}
