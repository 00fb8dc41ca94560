// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/process/wrapped_text.h"

#include <algorithm>
#include <sstream>

namespace flexneck::pipeline {

namespace {

bool continues(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

/// Removes and returns as many characters from the start of a word as fit.
std::string taken(std::string& word, std::size_t width) {
  std::size_t end = 0;
  for (std::size_t shown = 0; end < word.size() && (continues(word[end]) || shown < width); ++end)
    shown += continues(word[end]) ? 0 : 1;
  std::string begin = word.substr(0, end);
  word.erase(0, end);
  return begin;
}

}  // namespace

std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return !continues(c); }));
}

std::vector<std::string> wrapped_lines(const std::string& text, std::size_t width) {
  if (width_of(text) <= width) return {text};
  std::istringstream words(text);
  std::vector<std::string> lines = {""};
  for (std::string word; words >> word;) {
    const bool is_first = lines.back().empty();
    if (!is_first && width_of(lines.back()) + 1 + width_of(word) > width) lines.emplace_back();
    if (!lines.back().empty()) lines.back() += ' ';
    while (width_of(word) > width && lines.back().empty()) {
      lines.back() = taken(word, width);
      lines.emplace_back();
    }
    lines.back() += word;
  }
  return lines;
}

std::string wrapped(const std::string& text, const std::string& margin) {
  std::string all;
  for (const std::string& line : wrapped_lines(text, kConsoleColumns - margin.size()))
    all += margin + line + "\n";
  return all;
}

}  // namespace flexneck::pipeline
