// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/plotting/figure.h"

#include <fmt/core.h>

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

std::string script_head(const Figure& figure, int width, int height) {
  return fmt::format(
      "reset\n"
      "set datafile separator comma\n"
      "set terminal svg size {},{} dynamic rounded font 'sans-serif,14' background '#ffffff'\n"
      "set output '{}.svg'\n",
      width, height, stem_of(figure));
}

}  // namespace flexneck::pipeline
