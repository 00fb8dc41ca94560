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

/// The same as the label of a tic, which has no options.
std::string gnuplot_tic(const std::string& text);

/// A name of a file: what an output or a curve is called, with '-' for what files have not.
std::string file_part_of(const std::string& name);

/// Beginning of a script for a picture <stem>.svg of a sweep or a fit, with axes and a grid.
std::string picture_head(const std::string& stem, int width, int height);

/// Beginning of every script: size, fonts and the name of the picture.
std::string script_head(const Figure& figure, int width, int height);

}  // namespace flexneck::pipeline
