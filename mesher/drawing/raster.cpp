// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/drawing/raster.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace flexneck::mesher {
namespace {

/// Twice the signed area of a triangle on the screen.
double doubled_area(const ScreenPoint& a, const ScreenPoint& b, const ScreenPoint& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// First and last pixel whose centre lies between two coordinates, within 0 … size - 1.
std::array<int, 2> pixel_range(double low, double high, int size) {
  return {static_cast<int>(std::clamp(std::ceil(low - 0.5), 0.0, size + 0.0)),
          static_cast<int>(std::clamp(std::floor(high - 0.5), -1.0, size - 1.0))};
}

/// The part of a line, in fractions of it, whose coordinate from a to b lies between two others.
struct Part {
  double begin = 0, end = 1;

  void clip(double a, double b, double low, double high) {
    if (a == b) {
      if (a < low || a > high) end = -1;
      return;
    }
    const auto [first, last] = std::minmax({(low - a) / (b - a), (high - a) / (b - a)});
    begin = std::max(begin, first);
    end = std::min(end, last);
  }
};

ScreenPoint finer(const ScreenPoint& point) {
  return {point.x() * Raster::kFineness, point.y() * Raster::kFineness, point.z()};
}

}  // namespace

Raster::Raster(int width, int height, const Colour& background)
    : width_(width),
      height_(height),
      fine_width_(width * kFineness),
      fine_height_(height * kFineness),
      depths_(static_cast<std::size_t>(fine_width_) * static_cast<std::size_t>(fine_height_),
              -std::numeric_limits<double>::infinity()),
      colours_(depths_.size(), background) {}

void Raster::set(int x, int y, double depth, const Colour& colour) {
  const std::size_t pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(fine_width_) +
                            static_cast<std::size_t>(x);
  if (depth < depths_[pixel]) return;
  depths_[pixel] = depth;
  colours_[pixel] = colour;
}

void Raster::draw_triangle(const std::array<ScreenPoint, 3>& corners,
                           const std::array<Colour, 3>& colours) {
  const std::array<ScreenPoint, 3> p = {finer(corners[0]), finer(corners[1]), finer(corners[2])};
  const double area = doubled_area(p[0], p[1], p[2]);
  if (area == 0 || !std::isfinite(area)) return;
  const auto [x_low, x_high] = std::minmax({p[0].x(), p[1].x(), p[2].x()});
  const auto [y_low, y_high] = std::minmax({p[0].y(), p[1].y(), p[2].y()});
  const auto columns = pixel_range(x_low, x_high, fine_width_);
  const auto rows = pixel_range(y_low, y_high, fine_height_);
  for (int y = rows[0]; y <= rows[1]; ++y) {
    for (int x = columns[0]; x <= columns[1]; ++x) {
      const ScreenPoint here(x + 0.5, y + 0.5, 0);
      const double a = doubled_area(here, p[1], p[2]) / area;
      const double b = doubled_area(p[0], here, p[2]) / area;
      const double c = 1 - a - b;
      if (a < 0 || b < 0 || c < 0) continue;
      set(x, y, a * p[0].z() + b * p[1].z() + c * p[2].z(),
          static_cast<float>(a) * colours[0] + static_cast<float>(b) * colours[1] +
              static_cast<float>(c) * colours[2]);
    }
  }
}

void Raster::draw_line(const ScreenPoint& from, const ScreenPoint& to, const Colour& colour,
                       double width_pixels, double lift) {
  const ScreenPoint a = finer(from);
  const ScreenPoint b = finer(to);
  const double length = std::hypot(b.x() - a.x(), b.y() - a.y());
  const double radius = width_pixels * kFineness / 2;
  constexpr double kFarthest = 1e15;  // in pixels; a double counts many times as many
  if (!(length < kFarthest)) return;
  Part part;
  part.clip(a.x(), b.x(), -radius - 1, fine_width_ + radius + 1);
  part.clip(a.y(), b.y(), -radius - 1, fine_height_ + radius + 1);
  if (part.begin > part.end) return;
  const double steps = std::ceil(length) + 1;
  const auto first = static_cast<std::int64_t>(std::floor(part.begin * steps));
  const auto last = static_cast<std::int64_t>(std::ceil(part.end * steps));
  for (std::int64_t s = first; s <= last; ++s) {
    const ScreenPoint here = a + (b - a) * static_cast<double>(s) / steps;
    const auto columns = pixel_range(here.x() - radius, here.x() + radius, fine_width_);
    const auto rows = pixel_range(here.y() - radius, here.y() + radius, fine_height_);
    for (int y = rows[0]; y <= rows[1]; ++y) {
      for (int x = columns[0]; x <= columns[1]; ++x) set(x, y, here.z() + lift, colour);
    }
  }
}

std::vector<std::uint32_t> Raster::pixels() const {
  std::vector<std::uint32_t> result;
  result.reserve(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
  for (int y = 0; y < height_; ++y) {
    for (int x = 0; x < width_; ++x) {
      Colour mean = Colour::Zero();
      for (int j = 0; j < kFineness; ++j) {
        const int row = y * kFineness + j;
        const int column = x * kFineness;
        const std::size_t first =
            static_cast<std::size_t>(row) * static_cast<std::size_t>(fine_width_) +
            static_cast<std::size_t>(column);
        for (std::size_t i = 0; i < kFineness; ++i) mean += colours_[first + i];
      }
      mean = (mean / (kFineness * kFineness)).cwiseMax(0).cwiseMin(1);
      std::uint32_t value = 0;
      for (const float channel : mean) {
        value = value << 8U | static_cast<std::uint32_t>(std::lround(channel * 255));
      }
      result.push_back(value);
    }
  }
  return result;
}

}  // namespace flexneck::mesher
