// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/laboratory/iso_mme/descriptor_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "geometry/foundation/error.h"
#include "geometry/foundation/printable.h"
#include "geometry/foundation/text_file.h"
#include "mesher/exchange/text_lines.h"

namespace flexneck::pipeline {

namespace {

constexpr std::size_t kMaxBytes = 64U << 20U;
bool same_word(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [&](char x, char y) { return lower(x) == lower(y); });
}

}  // namespace

DescriptorFile::DescriptorFile(std::filesystem::path path) : path_(std::move(path)) {
  const std::string text = read_encoded_text(path_, kMaxBytes);
  mesher::TextLines rows(text);
  bool in_samples = false;
  while (const auto row = rows.next()) {
    const std::string_view content = mesher::trimmed(*row);
    if (content.empty()) continue;
    const auto number = static_cast<int>(rows.number());
    const std::size_t colon = content.find(':');
    in_samples = in_samples || colon == std::string_view::npos;
    if (in_samples) {
      lines_.push_back({number, "", std::string(content)});
      continue;
    }
    lines_.push_back({number, std::string(mesher::trimmed(content.substr(0, colon))),
                      std::string(mesher::trimmed(content.substr(colon + 1)))});
    ++descriptors_;
    if (lines_.back().key.empty())
      refuse(lines_.back(), "expected \"Key :value\", found no key before the colon");
  }
}

const DescriptorFile::Line* DescriptorFile::find(std::string_view key) const {
  const auto lines = descriptors();
  const auto found = std::find_if(lines.begin(), lines.end(),
                                  [&](const Line& line) { return same_word(line.key, key); });
  if (found == lines.end() || found->text.empty() || same_word(found->text, "NOVALUE"))
    return nullptr;
  return &*found;
}

const DescriptorFile::Line& DescriptorFile::need(std::string_view key) const {
  if (const Line* const line = find(key)) return *line;
  refuse("expected a line \"" + std::string(key) + " :…\" with a value, found none");
}

double DescriptorFile::number(std::string_view key) const { return number(need(key)); }

double DescriptorFile::number(const Line& line) const {
  std::string_view text = line.text;
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc() && end == text.data() + text.size() && std::isfinite(value))
    return value;
  const std::string what = line.key.empty() ? "a sample" : "a finite number of " + line.key;
  if (same_word(text, "NOVALUE"))
    refuse(line, "expected " + what + ", found NOVALUE; curves with gaps are not supported");
  refuse(line, "expected " + (line.key.empty() ? "a finite number" : what) + ", found \"" +
                   printable(line.text) + "\"");
}

void DescriptorFile::refuse(const Line& line, const std::string& problem) const {
  throw InputError(path_.string() + ":" + std::to_string(line.number) + ": " + problem);
}

void DescriptorFile::refuse(const std::string& problem) const {
  throw InputError(path_.string() + ": " + problem);
}

}  // namespace flexneck::pipeline
