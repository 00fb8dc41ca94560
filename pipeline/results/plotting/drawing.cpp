// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/results/plotting/drawing.h"

#include <cmath>

#include <fmt/core.h>

namespace flexneck::pipeline {

namespace {

constexpr double kMargin = 0.04;  ///< fraction of the larger extent, on each side

std::string csv_of(const Drawing& drawing) {
  std::string csv = fmt::format("shape,x [{0}],y [{0}]\n", drawing.unit);
  for (std::size_t s = 0; s < drawing.shapes.size(); ++s) {
    const Drawing::Shape& shape = drawing.shapes[s];
    if (s > 0) csv += "\n\n";
    for (Eigen::Index k = 0; k < shape.points.cols(); ++k) {
      csv += fmt::format("{},{:.6g},{:.6g}\n", shape.name, shape.points(0, k), shape.points(1, k));
    }
  }
  return csv;
}

/// Range of the drawing, including a margin.
Eigen::Matrix2d range_of(const Drawing& drawing) {
  Eigen::Matrix2d range;  // columns: low, high
  range.col(0).setConstant(1e300);
  range.col(1).setConstant(-1e300);
  const auto cover = [&](const Eigen::Vector2d& point) {
    range.col(0) = range.col(0).cwiseMin(point);
    range.col(1) = range.col(1).cwiseMax(point);
  };
  for (const Drawing::Shape& shape : drawing.shapes) {
    for (Eigen::Index k = 0; k < shape.points.cols(); ++k) cover(shape.points.col(k));
  }
  for (const Drawing::Arrow& arrow : drawing.arrows) {
    cover(arrow.from);
    cover(arrow.to);
  }
  for (const Drawing::Label& label : drawing.labels) cover(label.at);
  const double margin = kMargin * (range.col(1) - range.col(0)).maxCoeff();
  range.col(0).array() -= margin;
  range.col(1).array() += margin;
  return range;
}

std::string arrow_script(const Drawing::Arrow& arrow) {
  return fmt::format("set arrow from {:.6g},{:.6g} to {:.6g},{:.6g} {} filled front {}\n",
                     arrow.from.x(), arrow.from.y(), arrow.to.x(), arrow.to.y(),
                     arrow.has_two_heads ? "heads" : "head", arrow.style);
}

std::string label_script(const Drawing::Label& label) {
  return fmt::format("set label {} at {:.6g},{:.6g} {} front\n", gnuplot_text(label.text),
                     label.at.x(), label.at.y(), label.side);
}

std::string shape_script(const Drawing::Shape& shape, std::size_t index, const std::string& file) {
  const std::string data = fmt::format("'{}' skip 1 index {} using 2:3", file, index);
  if (shape.fill.empty()) return data + " with lines notitle " + shape.line;
  return fmt::format(
      "{0} with filledcurves closed notitle fc rgb '{1}', {0} with lines notitle {2}", data,
      shape.fill, shape.line);
}

}  // namespace

void draw(const Drawing& drawing, Figure& figure) {
  const std::string file = stem_of(figure) + ".csv";
  const Eigen::Matrix2d range = range_of(drawing);
  figure.csv = csv_of(drawing);
  figure.script =
      script_head(figure, drawing.width, drawing.height) +
      fmt::format(
          "set size ratio -1\nunset border\nunset tics\nunset key\nset margins 1,1,1,1\n"
          "set xrange [{:.6g}:{:.6g}]\nset yrange [{:.6g}:{:.6g}]\n",
          range(0, 0), range(0, 1), range(1, 0), range(1, 1));
  for (const Drawing::Arrow& arrow : drawing.arrows) figure.script += arrow_script(arrow);
  for (const Drawing::Label& label : drawing.labels) figure.script += label_script(label);
  for (std::size_t s = 0; s < drawing.shapes.size(); ++s) {
    figure.script += (s == 0 ? "plot " : ", ") + shape_script(drawing.shapes[s], s, file);
  }
  figure.script += "\n";
}

Drawing::Points arc(const Eigen::Vector2d& centre, double radius, double from_rad, double to_rad) {
  constexpr int kSteps = 32;
  Drawing::Points points(2, kSteps + 1);
  for (int k = 0; k <= kSteps; ++k) {
    const double angle = from_rad + (to_rad - from_rad) * k / kSteps;
    points.col(k) = centre + radius * Eigen::Vector2d(std::sin(angle), std::cos(angle));
  }
  return points;
}

}  // namespace flexneck::pipeline
