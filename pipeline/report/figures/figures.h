// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/plotting/figure.h"
#include "pipeline/report/results.h"

namespace flexneck::pipeline {

/// A figure with its picture.
struct DrawnFigure {
  Figure figure;
  std::string svg;  ///< empty if it is not drawn
};

/// Figures drawn by gnuplot as far as there is something to draw: of the neck the paper's by the
/// numbers of its captions, of any structure the tornado of its sensitivities. Each becomes
/// figure-NN.svg and figure-NN.csv in `folder`, or tornado.svg and tornado.csv; those of another
/// run that cannot be drawn now are removed.
/// @throws InputError if gnuplot is missing, with its package's name, or a file cannot be written.
std::vector<DrawnFigure> draw_figures(const Results& results, const Study& study,
                                      const std::filesystem::path& folder);

/// The paper's figures for the page, each with its caption and remarks.
std::string figures_html(const std::vector<DrawnFigure>& figures);
/// The tornado likewise; empty if it is not drawn.
std::string tornado_html(const std::vector<DrawnFigure>& figures);

}  // namespace flexneck::pipeline
