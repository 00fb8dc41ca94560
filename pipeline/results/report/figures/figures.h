// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/results/plotting/figure.h"
#include "pipeline/results/report/results.h"

namespace flexneck::pipeline {

/// A figure with its picture.
struct DrawnFigure {
  Figure figure;
  std::string svg;  ///< empty if the figure is not drawn
};

/// Draws by gnuplot the figures for which there are data: for the neck the paper's by the numbers
/// of its captions, for any structure the tornado of its sensitivities. Each becomes figure-NN.svg
/// and figure-NN.csv in `folder`, or tornado.svg and tornado.csv; figures of an earlier run that
/// cannot be drawn now are removed.
/// @throws InputError if gnuplot is missing, with its package's name, or a file cannot be written.
std::vector<DrawnFigure> draw_figures(const Results& results, const Study& study,
                                      const std::filesystem::path& folder);

/// HTML of the paper's figures, each with its caption and remarks.
std::string figures_html(const std::vector<DrawnFigure>& figures);
/// HTML of the tornado; empty if it is not drawn.
std::string tornado_html(const std::vector<DrawnFigure>& figures);

}  // namespace flexneck::pipeline
