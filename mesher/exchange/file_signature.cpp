// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/exchange/file_signature.h"

#include <algorithm>
#include <array>
#include <charconv>

#include "geometry/foundation/ascii.h"
#include "mesher/exchange/inp_cards.h"
#include "mesher/exchange/text_lines.h"

namespace flexneck::mesher {
namespace {

/// The beginning of a file for a message: printable and short.
std::string shown(std::string_view text) {
  std::string result;
  for (const char c : text.substr(0, 24)) {
    if (c == '\n' || c == '\r') break;
    result += c >= ' ' && c <= '~' ? c : '?';
  }
  return "'" + result + "'";
}

bool is_text(std::string_view contents) { return contents.find('\0') == std::string_view::npos; }

/// Checks sections $Name … $EndName with nothing but blank lines between them.
std::string msh_section_problem(TextLines lines) {
  std::string open;
  bool has_nodes = false;
  bool has_elements = false;
  while (const auto line = lines.next()) {
    const std::string_view text = trimmed(*line);
    const std::string at = "line " + std::to_string(lines.number());
    if (!open.empty()) {
      if (text == "$End" + open) open.clear();
      continue;
    }
    if (text.empty()) continue;
    if (text.front() != '$' || text.starts_with("$End")) {
      return at + " is outside all sections: " + shown(text);
    }
    open = text.substr(1);
    has_nodes = has_nodes || open == "Nodes" || open == "ParametricNodes";
    has_elements = has_elements || open == "Elements";
  }
  if (!open.empty()) return "section $" + open + " has no end; the file is truncated";
  if (!has_nodes || !has_elements) return "expected $Nodes and $Elements, found only one or none";
  return {};
}

/// Checks a binary .msh. The four bytes after the header give the byte order: the number one, as
/// this machine writes it.
std::string msh_binary_problem(std::string_view contents) {
  constexpr std::string_view kOne("\1\0\0\0", 4);
  if (!contents.starts_with(kOne)) return "its byte order is that of another machine";
  TextLines lines(contents.substr(kOne.size()));
  lines.next();  // rest of the line
  if (!trimmed(lines.next().value_or("")).starts_with("$End")) {
    return "section $MeshFormat has no end";
  }
  const bool is_parametric = contents.find("$ParametricNodes") != std::string_view::npos;
  const std::string nodes = is_parametric ? "ParametricNodes" : "Nodes";
  for (const std::string& name :
       {"$" + nodes, "$End" + nodes, std::string("$Elements"), std::string("$EndElements")}) {
    if (contents.find(name) == std::string_view::npos) {
      return "there is no " + name + "; the file is truncated, or contains no mesh";
    }
  }
  return {};
}

std::string msh_problem(std::string_view contents) {
  TextLines lines(contents);
  const std::string_view first = lines.next().value_or("");
  if (first != "$MeshFormat") {
    return "expected $MeshFormat in the first line, found " + shown(first);
  }
  const std::string_view header = trimmed(lines.next().value_or(""));
  constexpr std::array<std::string_view, 7> kVersions = {"2", "2.0", "2.1", "2.2",
                                                         "4", "4.0", "4.1"};
  const std::string_view version = header.substr(0, header.find(' '));
  if (std::find(kVersions.begin(), kVersions.end(), version) == kVersions.end()) {
    return "expected version 2.0, 2.1, 2.2, 4.0 or 4.1, found " + shown(header);
  }
  const std::string_view kind = trimmed(header.substr(version.size()));
  if (kind == "1 8" || kind == "1 4") return msh_binary_problem(lines.rest());
  if (kind != "0 8" && kind != "0 4") {
    return "expected a file type of 0 or 1 and a data size of 8, found " + shown(header);
  }
  if (!is_text(contents)) return "its header says text, but its content is binary";
  return msh_section_problem(TextLines(contents));
}

/// Checks data sets between lines of -1, the first line among them.
std::string unv_problem(std::string_view contents) {
  TextLines lines(contents);
  const std::string_view first = lines.next().value_or("");
  if (!is_text(contents) || trimmed(first) != "-1") {
    return "expected -1 in the first line, found " + shown(first);
  }
  const std::string_view number = trimmed(lines.next().value_or(""));
  int data_set = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), data_set);
  if (error != std::errc() || end != number.data() + number.size()) {
    return "expected the number of a data set in the second line, found " + shown(number);
  }
  return {};
}

/// Checks cards in free or fixed fields; comments and case control may come first.
std::string bdf_problem(std::string_view contents) {
  if (!is_text(contents)) return "it is not a text file";
  bool has_grid = false;
  bool has_element = false;
  TextLines lines(contents);
  while (const auto line = lines.next()) {
    const std::string name = upper_case(line->substr(0, 8));
    has_grid = has_grid || name.starts_with("GRID");
    for (const std::string_view card : {"CTETRA", "CHEXA", "CPENTA", "CPYRAM"}) {
      has_element = has_element || name.starts_with(card);
    }
  }
  if (!has_grid) return "expected a GRID card, found none; it begins with " + shown(contents);
  if (!has_element) return "expected a CHEXA, CPENTA or CTETRA card, found none";
  return {};
}

std::string step_problem(std::string_view contents) {
  if (contents.starts_with("ISO-10303-21;")) return {};
  return "expected ISO-10303-21; in the first line, found " + shown(contents);
}

std::string brep_problem(std::string_view contents) {
  TextLines lines(contents);
  std::string_view first = lines.next().value_or("");
  if (first == "DBRep_DrawableShape") {
    first = lines.next().value_or("");
    if (trimmed(first).empty()) first = lines.next().value_or("");
  }
  if (first.starts_with("CASCADE Topology V")) return {};
  return "expected 'CASCADE Topology V…' in the first lines, found " + shown(first);
}

/// Checks lines of keywords and data; the first line that is no comment is a keyword.
std::string inp_problem(std::string_view contents) {
  if (!is_text(contents)) return "it is not a text file";
  TextLines lines(contents);
  while (const auto line = lines.next()) {
    const std::string_view text = trimmed(*line);
    if (text.empty() || text.starts_with("**")) continue;
    if (text.size() > 1 && text[0] == '*' && is_letter(text[1])) {
      return {};
    }
    return "expected a keyword such as *NODE in line " + std::to_string(lines.number()) +
           ", found " + shown(text);
  }
  return "it is empty";
}

}  // namespace

std::string signature_problem(ForeignFormat format, std::string_view contents) {
  switch (format) {
    case ForeignFormat::msh:
      return msh_problem(contents);
    case ForeignFormat::unv:
      return unv_problem(contents);
    case ForeignFormat::bdf:
      return bdf_problem(contents);
    case ForeignFormat::inp:
      return inp_problem(contents);
    case ForeignFormat::step:
      return step_problem(contents);
    case ForeignFormat::brep:
      return brep_problem(contents);
  }
  return "its format is unknown";
}

}  // namespace flexneck::mesher
