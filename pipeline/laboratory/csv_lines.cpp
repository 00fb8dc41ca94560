// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/laboratory/csv_lines.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "geometry/foundation/printable.h"
#include "geometry/foundation/text_file.h"

namespace flexneck::pipeline {
namespace {

constexpr std::size_t kMaxBytes = 64U << 20U;

}  // namespace

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

CsvHeader csv_header(const std::string& cell) {
  const std::size_t open = cell.rfind('[');
  if (open == std::string::npos || cell.back() != ']') return {cell, ""};
  const std::string_view text = cell;
  return {std::string(trimmed(text.substr(0, open))),
          std::string(trimmed(text.substr(open + 1, cell.size() - open - 2)))};
}

CsvLines::CsvLines(const std::filesystem::path& path)
    : path_(path), stream_(read_text(path, kMaxBytes)) {}

bool CsvLines::next(std::vector<std::string>& cells) {
  for (std::string line; std::getline(stream_, line);) {
    ++line_;
    if (line.ends_with('\r')) line.pop_back();
    if (line.find('\r') != std::string::npos) refuse("expected lines that end in LF or CRLF");
    const std::string_view text = trimmed(line);
    if (text.empty() || text.front() == '#') continue;
    cells = cells_of(line);
    if (columns_ == 0) columns_ = cells.size();
    if (cells.size() != columns_)
      refuse("expected " + std::to_string(columns_) + " cells as in the header line, found " +
             std::to_string(cells.size()) + kMarks);
    return true;
  }
  return false;
}

double CsvLines::number(const std::string& cell, double factor) const {
  double value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc() || end != cell.data() + cell.size() || !std::isfinite(value * factor))
    refuse("expected a finite number, found \"" + printable(cell) + "\"" +
           (cell.find_first_of(",; \t") == std::string::npos ? "" : kMarks));
  return value * factor;
}

void CsvLines::refuse(const std::string& problem) const {
  throw InputError(path_.string() + ":" + std::to_string(line_) + ": " + problem);
}

std::vector<std::string> CsvLines::cells_of(const std::string& line) const {
  std::vector<std::string> cells;
  const std::string_view text = line;
  for (std::size_t at = 0;;) {
    at = std::min(text.find_first_not_of(" \t", at), text.size());
    std::string cell;
    std::size_t end = at;
    const bool is_quoted = at < text.size() && text[at] == '"';
    if (is_quoted) {
      for (++end;; ++end) {
        if (end >= text.size())
          refuse("expected a closing quote \" at the end of a quoted cell, found none");
        if (text[end] == '"' && text.substr(end + 1, 1) != "\"") break;
        if (text[end] == '"') ++end;
        cell += text[end];
      }
      at = end + 1;
    }
    end = std::min(text.find(',', at), text.size());
    const std::string_view rest = trimmed(text.substr(at, end - at));
    if (is_quoted && !rest.empty()) {
      refuse("expected a comma after the closing quote \" of a cell, found \"" +
             printable(std::string(rest)) + "\"");
    }
    cell += rest;
    cells.push_back(cell);
    if (end == text.size()) return cells;
    at = end + 1;
  }
}

std::size_t csv_column(const CsvLines& file, const std::vector<std::string>& names,
                       const std::string& column, const std::string& how) {
  std::vector<std::string> others;
  std::string listed;
  for (std::size_t c = 1; c < names.size(); ++c) {
    others.push_back(csv_header(names[c]).name);
    listed += (listed.empty() ? "'" : ", '") + others.back() + "'";
  }
  if (column.empty()) {
    if (others.size() == 1) return 1;
    file.refuse("there are several columns; choose one of " + listed + " " + how);
  }
  if (std::count(others.begin(), others.end(), column) > 1)
    file.refuse("there are several columns '" + column + "'; names must differ");
  try {
    return 1 + find_name(others, column, "column");
  } catch (const InputError& error) {
    file.refuse(error.what());
  }
}

}  // namespace flexneck::pipeline
