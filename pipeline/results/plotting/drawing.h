// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "pipeline/results/plotting/figure.h"

namespace flexneck::pipeline {

/// A drawing in a plane, to scale, x to the right and y upwards.
struct Drawing {
  using Points = Eigen::Matrix2Xd;
  struct Shape {
    std::string name;
    Points points;          ///< the last point is joined to the first if the shape is filled
    std::string fill = {};  ///< colour; empty: a line
    std::string line = "lw 1.2 lc rgb '#222222'";
  };
  struct Arrow {
    Eigen::Vector2d from, to;
    std::string style = "lw 2 lc rgb '#0072b2'";
    bool has_two_heads = false;
  };
  struct Label {
    std::string text;
    Eigen::Vector2d at;
    std::string side = "left";  ///< alignment of the text at the point: left, center, right
  };
  std::string unit;  ///< unit of the coordinates in the CSV
  std::vector<Shape> shapes;
  std::vector<Arrow> arrows;
  std::vector<Label> labels;
  int width = 640, height = 560;
};

/// Fills in the CSV, one block for each shape, and the script.
void draw(const Drawing& drawing, Figure& figure);

/// Points on an arc from one angle to another, rad, counted from the y axis towards x.
Drawing::Points arc(const Eigen::Vector2d& centre, double radius, double from_rad, double to_rad);

}  // namespace flexneck::pipeline
