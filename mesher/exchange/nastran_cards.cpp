// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/exchange/nastran_cards.h"

#include "mesher/exchange/inp_cards.h"
#include "mesher/exchange/text_lines.h"

namespace flexneck::mesher {
namespace {

constexpr std::size_t kNameWidth = 8;

bool is_free(std::string_view line) { return line.find(',') != std::string_view::npos; }

/// The first field of a line: a name, or a mark that the line continues a card.
std::string_view head_of(std::string_view line) {
  return trimmed(is_free(line) ? line.substr(0, line.find(',')) : line.substr(0, kNameWidth));
}

bool is_continuation(std::string_view line) {
  const std::string_view head = head_of(line);
  return head.empty() || head.front() == '+' || head.front() == '*';
}

/// Appends the fields of a line, up to the mark of the next line: eight, or four wide ones.
void add_fields(std::string_view line, std::vector<std::string>& fields) {
  const bool is_wide = head_of(line).find('*') != std::string_view::npos;
  const std::size_t count = is_wide ? 4 : 8;
  if (is_free(line)) {
    for (std::size_t f = 0; f < count; ++f) {
      const std::size_t comma = line.find(',');
      line = comma == std::string_view::npos ? std::string_view() : line.substr(comma + 1);
      fields.emplace_back(trimmed(line.substr(0, line.find(','))));
    }
    return;
  }
  const std::size_t width = is_wide ? 16 : 8;
  for (std::size_t f = 0; f < count; ++f) {
    const std::size_t begin = kNameWidth + f * width;
    fields.emplace_back(begin < line.size() ? trimmed(line.substr(begin, width)) : "");
  }
}

NastranCard card_of(std::string_view line, std::size_t number) {
  const std::string_view head = head_of(line);
  return {
      .name = upper_case(head.substr(0, head.find_first_of("* \t"))), .fields = {}, .line = number};
}

void add_line(std::string_view line, NastranCard& card) {
  add_fields(line, card.fields);
  card.has_tabs = card.has_tabs || (!is_free(line) && line.find('\t') != std::string_view::npos);
}

bool begins_bulk(std::string_view line) {
  const std::string words = upper_case(trimmed(line));
  return words.starts_with("BEGIN") && words.ends_with("BULK");
}

/// Lines up to BEGIN BULK are no cards; a file without it is bulk data from the first line on.
std::size_t last_line_before_bulk(std::string_view text) {
  TextLines lines(text);
  while (const auto line = lines.next()) {
    if (begins_bulk(*line)) return lines.number();
  }
  return 0;
}

}  // namespace

void for_each_nastran_card(std::string_view text,
                           const std::function<void(const NastranCard&)>& visit) {
  const std::size_t before = last_line_before_bulk(text);
  TextLines lines(text);
  NastranCard card;
  while (const auto raw = lines.next()) {
    const std::string_view line = raw->substr(0, raw->find('$'));  // a comment goes to the end
    if (lines.number() <= before || trimmed(line).empty()) continue;
    if (!is_continuation(line)) {
      if (!card.name.empty()) visit(card);
      card = card_of(line, lines.number());
      if (card.name == "ENDDATA") return;
    }
    if (!card.name.empty()) add_line(line, card);
  }
  if (!card.name.empty()) visit(card);
}

}  // namespace flexneck::mesher
