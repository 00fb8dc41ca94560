// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/exchange/nastran_cards.h"

#include <algorithm>
#include <map>
#include <optional>

#include "geometry/foundation/ascii.h"
#include "geometry/foundation/error.h"
#include "mesher/exchange/inp_cards.h"
#include "mesher/exchange/text_lines.h"

namespace flexneck::mesher {
namespace {

constexpr std::size_t kNameWidth = 8;
constexpr std::size_t kMarkColumn = 72;  ///< column of the last field, counted from 0

[[noreturn]] void refuse_line(std::size_t number, const std::string& problem) {
  throw InputError("line " + std::to_string(number) + ": " + problem);
}

/// A line of bulk data.
struct BulkLine {
  std::size_t number = 0;
  std::string head;                 ///< its first field in capitals
  std::vector<std::string> fields;  ///< eight, or four wide ones
  std::string mark;                 ///< continuation mark without its first character
  bool needs_more = false;          ///< the mark begins with a +
  bool is_wide = false;
  bool has_tabs = false;
  std::optional<std::size_t> next;  ///< the line that continues it

  bool is_continuation() const {
    return head.empty() || head.front() == '+' || head.front() == '*';
  }
};

/// True for free fields: a comma stands in the first ten columns.
bool is_free(std::string_view line) {
  return line.substr(0, 10).find(',') != std::string_view::npos;
}

std::vector<std::string> free_fields(std::string_view line) {
  std::vector<std::string> fields;
  for (std::size_t comma = 0; comma != std::string_view::npos;) {
    comma = line.find(',');
    fields.emplace_back(trimmed(line.substr(0, comma)));
    line.remove_prefix(comma == std::string_view::npos ? line.size() : comma + 1);
  }
  while (fields.size() > 1 && fields.back().empty()) fields.pop_back();
  return fields;
}

/// A continuation mark without its first character, + or *.
std::string mark_of(std::string_view text) {
  const std::string_view whole = trimmed(text);
  if (whole.empty()) return {};
  if (whole.front() == '+' || whole.front() == '*') text = whole;
  return upper_case(trimmed(text.substr(1)));
}

void set_mark(std::string_view text, BulkLine& line) {
  line.mark = mark_of(text);
  line.needs_more = !line.mark.empty() && trimmed(text).front() == '+';
}

void read_free(std::string_view text, BulkLine& line) {
  std::vector<std::string> all = free_fields(text);
  line.head = upper_case(all.front());
  line.is_wide = line.head.find('*') != std::string::npos;
  const std::size_t count = line.is_wide ? 4 : 8;
  if (all.size() > count + 1) {
    const std::string& last = all[count + 1];
    const char first = last.empty() ? '0' : last.front();
    const bool is_mark = first == '+' || first == '*' || is_letter(first);
    if (all.size() > count + 2 || !is_mark) {
      refuse_line(line.number, line.head + ": expected at most " + std::to_string(count) +
                                   " free fields per line and a continuation mark, found " +
                                   std::to_string(all.size() - 1) +
                                   "; write the rest of the card in a continuation line");
    }
    set_mark(last, line);
  }
  all.resize(count + 1);
  line.fields.assign(all.begin() + 1, all.end());
}

void read_fixed(std::string_view text, BulkLine& line) {
  line.head = upper_case(trimmed(text.substr(0, kNameWidth)));
  line.is_wide = line.head.find('*') != std::string::npos;
  line.has_tabs = text.find('\t') != std::string_view::npos;
  const std::size_t width = line.is_wide ? 16 : 8;
  for (std::size_t begin = kNameWidth; begin < kMarkColumn; begin += width) {
    line.fields.emplace_back(begin < text.size() ? trimmed(text.substr(begin, width)) : "");
  }
  if (text.size() > kMarkColumn) set_mark(text.substr(kMarkColumn, kNameWidth), line);
}

std::vector<BulkLine> lines_of(std::string_view text) {
  const std::size_t before = nastran_bulk_line(text);
  TextLines lines(text);
  std::vector<BulkLine> result;
  while (const auto raw = lines.next()) {
    const std::string_view line = without_comment(*raw);
    if (lines.number() <= before || trimmed(line).empty()) continue;
    BulkLine read;
    read.number = lines.number();
    is_free(line) ? read_free(line, read) : read_fixed(line, read);
    if (read.head == "ENDDATA") break;
    result.push_back(std::move(read));
  }
  return result;
}

/// Finds the line that each continuation continues.
void join(std::vector<BulkLine>& lines) {
  std::multimap<std::string, std::size_t> by_mark;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    if (!lines[k].mark.empty()) by_mark.emplace(lines[k].mark, k);
  }
  for (std::size_t k = 0; k < lines.size(); ++k) {
    if (!lines[k].is_continuation()) continue;
    const std::string mark = mark_of(lines[k].head);
    std::size_t parent = k - 1;
    if (k == 0 || !(mark.empty() || mark == lines[parent].mark)) {
      const auto [first, last] = by_mark.equal_range(mark);
      const auto count = std::distance(first, last);
      if (count != 1 || first->second == k) {
        refuse_line(lines[k].number, "expected one line whose last field is the mark '" +
                                         lines[k].head + "' of this continuation, found " +
                                         std::to_string(count));
      }
      parent = first->second;
    }
    if (lines[parent].next) {
      refuse_line(lines[k].number, "continues line " + std::to_string(lines[parent].number) +
                                       ", as line " +
                                       std::to_string(lines[*lines[parent].next].number) + " does");
    }
    lines[parent].next = k;
  }
}

/// The card of a line and all its continuation lines.
NastranCard card_from(const std::vector<BulkLine>& lines, std::size_t first) {
  NastranCard card{.name = lines[first].head.substr(0, lines[first].head.find_first_of("* \t")),
                   .fields = {},
                   .line = lines[first].number};
  for (std::optional<std::size_t> k = first; k; k = lines[*k].next) {
    const BulkLine& line = lines[*k];
    if (!line.is_wide) card.fields.resize((card.fields.size() + 7) / 8 * 8);
    card.fields.insert(card.fields.end(), line.fields.begin(), line.fields.end());
    card.has_tabs = card.has_tabs || line.has_tabs;
    if (line.needs_more && !line.next) {
      refuse_line(line.number,
                  card.name + ": expected a continuation line '+" + line.mark + "', found none");
    }
  }
  return card;
}

}  // namespace

std::string_view without_comment(std::string_view line) { return line.substr(0, line.find('$')); }

std::size_t nastran_bulk_line(std::string_view text) {
  TextLines lines(text);
  while (const auto line = lines.next()) {
    const std::string words = upper_case(trimmed(without_comment(*line)));
    if (words.starts_with("BEGIN") && words.ends_with("BULK")) return lines.number();
  }
  return 0;
}

std::vector<NastranCard> read_nastran_cards(std::string_view text) {
  std::vector<BulkLine> lines = lines_of(text);
  join(lines);
  std::vector<NastranCard> cards;
  std::vector<bool> is_read(lines.size(), false);
  for (std::size_t k = 0; k < lines.size(); ++k) {
    if (lines[k].is_continuation()) continue;
    cards.push_back(card_from(lines, k));
    for (std::optional<std::size_t> l = k; l; l = lines[*l].next) is_read[*l] = true;
  }
  const auto lost = std::find(is_read.begin(), is_read.end(), false);
  if (lost != is_read.end()) {
    refuse_line(
        lines[static_cast<std::size_t>(lost - is_read.begin())].number,
        "the continuation line belongs to no card, since the continuation marks form a cycle");
  }
  return cards;
}

}  // namespace flexneck::mesher
