// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace flexneck::pipeline {

/// A figure, ready to be drawn: one of the paper, or another one.
struct Figure {
  int number = 0;            ///< of the paper's caption; 0 of another figure
  std::string caption = {};  ///< the paper's, if it is one of the paper
  std::string remark = {};   ///< how the text counts it, what it shows here and what it cannot show
  std::string csv = {};      ///< what is drawn
  std::string script = {};  ///< gnuplot commands that draw it from the CSV, which they call by name
  std::string missing = {};  ///< why it is not drawn; empty if it is
  std::string name = {};     ///< of the files of another figure
};

/// "figure-07", or its name.
std::string stem_of(const Figure& figure);

/// A text in single quotes for gnuplot, the one way for a text into a script: enhanced text and
/// quotes in it mean nothing, and a line break, which would begin a command, is spelt out.
std::string gnuplot_text(const std::string& text);

/// Beginning of every script: size, fonts and the name of the picture.
std::string script_head(const Figure& figure, int width, int height);

}  // namespace flexneck::pipeline
