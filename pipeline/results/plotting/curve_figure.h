// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "pipeline/results/plotting/figure.h"

namespace flexneck::pipeline {

struct FigureCurve {
  std::string title;
  Eigen::VectorXd x, y;  ///< in the units of the axes
};

/// A shaded range behind the curves.
struct FigureBand {
  std::string label;
  double left = 0, right = 0, low = 0, high = 0;
};

struct CurvePlot {
  std::string x_label, y_label;  ///< with their units: "time [ms]"
  std::vector<FigureCurve> curves;
  std::vector<FigureBand> bands = {};
  /// Note at the foot of the picture.
  std::string note = "No reference curve: the paper's curves are not in its text";
};

/// Fills in the CSV and the script. Curves over the same x share its column.
void draw_curves(const CurvePlot& plot, Figure& figure);

}  // namespace flexneck::pipeline
