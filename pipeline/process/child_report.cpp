// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/process/child_report.h"

#include <algorithm>

namespace flexneck::pipeline {

namespace {

constexpr char kMark = '\x1e';  // ASCII's record separator, which no library prints
constexpr std::string_view kKinds = "dwric";

}  // namespace

std::string line_of(const ChildReport& report) {
  std::string text = report.text;
  std::replace(text.begin(), text.end(), '\n', ' ');
  return std::string("\n") + kMark + static_cast<char>(report.kind) + text + '\n';
}

std::optional<ChildReport> report_in(std::string_view line) {
  const std::size_t mark = line.find(kMark);
  if (mark == std::string_view::npos || mark + 1 >= line.size()) return std::nullopt;
  const char kind = line[mark + 1];
  if (kKinds.find(kind) == std::string_view::npos) return std::nullopt;
  return ChildReport{static_cast<ChildReport::Kind>(kind), std::string(line.substr(mark + 2))};
}

}  // namespace flexneck::pipeline
