// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/results/plotting/figure.h"

#include <fmt/core.h>

#include "geometry/foundation/ascii.h"
#include "geometry/foundation/printable.h"

namespace flexneck::pipeline {

std::string stem_of(const Figure& figure) {
  return figure.name.empty() ? fmt::format("figure-{:02}", figure.number) : figure.name;
}

std::string gnuplot_text(const std::string& text) {
  std::string quoted = "'";
  for (const char c : printable(text)) quoted += c == '\'' ? std::string("''") : std::string(1, c);
  return quoted + "' noenhanced";
}

std::string gnuplot_tic(const std::string& text) {
  std::string quoted = gnuplot_text(text);
  quoted.resize(quoted.rfind('\'') + 1);
  return quoted;
}

std::string file_part_of(const std::string& name) {
  std::string part = name;
  for (char& letter : part)
    if (!is_letter_or_digit(letter) && letter != '.' && letter != '_') letter = '-';
  return part;
}

std::string picture_head(const std::string& stem, int width, int height) {
  return fmt::format(
      "reset\nset datafile separator comma\nset terminal svg size {},{} dynamic rounded font "
      "'sans-serif,12' background '#ffffff'\nset xtics rotate by -35\nset output '{}.svg'\nset "
      "border 3 lc rgb '#444444'\n"
      "set tics nomirror\nset grid lc rgb '#dddddd' lt 1\n",
      width, height, stem);
}

std::string script_head(const Figure& figure, int width, int height) {
  return fmt::format(
      "reset\n"
      "set datafile separator comma\n"
      "set terminal svg size {},{} dynamic rounded font 'sans-serif,14' background '#ffffff'\n"
      "set output '{}.svg'\n",
      width, height, stem_of(figure));
}

}  // namespace flexneck::pipeline
