// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace flexneck::mesher {

/// Red, green and blue, each 0 … 1.
using Colour = Eigen::Vector3f;

/// A point of the picture: x to the right and y down in pixels, z towards the eye.
using ScreenPoint = Eigen::Vector3d;

/// A picture with a depth buffer: points nearer to the eye hide those behind them. It is drawn at
/// three times the resolution at which it is read, which smooths the edges.
class Raster {
 public:
  static constexpr int kFineness = 3;

  Raster(int width, int height, const Colour& background);

  int width() const { return width_; }
  int height() const { return height_; }

  void draw_triangle(const std::array<ScreenPoint, 3>& corners,
                     const std::array<Colour, 3>& colours);
  /// Draws a line.
  /// @param lift brings the line nearer to the eye, so that it shows on the surface it lies on
  void draw_line(const ScreenPoint& from, const ScreenPoint& to, const Colour& colour,
                 double width_pixels, double lift);

  /// The smoothed picture, row by row from the top, 0xRRGGBB in each entry.
  std::vector<std::uint32_t> pixels() const;

 private:
  void set(int x, int y, double depth, const Colour& colour);

  int width_, height_;
  int fine_width_, fine_height_;
  std::vector<double> depths_;
  std::vector<Colour> colours_;
};

}  // namespace flexneck::mesher
