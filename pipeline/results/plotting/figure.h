// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace flexneck::pipeline {

/// A figure, ready to be drawn: one of the paper, or another one.
struct Figure {
  int number = 0;            ///< number in the paper's caption; 0 for another figure
  std::string caption = {};  ///< caption in the paper, if the figure is one of it
  std::string remark = {};   ///< numbering in the text, what is shown here and what cannot be shown
  std::string csv = {};      ///< data drawn
  std::string script = {};   ///< gnuplot commands that draw the CSV, which they refer to by name
  std::string missing = {};  ///< reason why it is not drawn; empty if it is
  std::string name = {};     ///< name of the files, for another figure
};

/// Stem of the files' names: "figure-07", or the figure's name.
std::string stem_of(const Figure& figure);

/// Quotes a text for a gnuplot script with single quotes, the only way for texts into scripts:
/// enhanced text and quotes have no effect, and line breaks, which would begin a command, are spelt
/// out.
std::string gnuplot_text(const std::string& text);

/// Quotes a text as the label of a tic, which takes no options.
std::string gnuplot_tic(const std::string& text);

/// Part of a file's name for an output or a curve, with '-' for characters that file names lack.
std::string file_part_of(const std::string& name);

/// Beginning of a script for a picture <stem>.svg of a sweep or a fit, with axes and a grid.
std::string picture_head(const std::string& stem, int width, int height);

/// Beginning of a script for a figure: size, fonts and the name of the picture.
std::string script_head(const Figure& figure, int width, int height);

}  // namespace flexneck::pipeline
