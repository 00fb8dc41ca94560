// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/results/report/figures/neck_outline.h"

#include "geometry/foundation/units.h"

namespace flexneck::pipeline {

namespace {

/// Points on each vertical side of a layer, so that it can bend.
constexpr int kSidePoints = 6;

/// Closed outline of a rectangle.
Eigen::Matrix2Xd rectangle(double left, double right, double bottom, double top) {
  Eigen::Matrix2Xd points(2, 2 * kSidePoints + 1);
  for (int k = 0; k < kSidePoints; ++k) {
    const double height = bottom + (top - bottom) * k / (kSidePoints - 1);
    points.col(k) = Eigen::Vector2d(right, height);
    points.col(2 * kSidePoints - 1 - k) = Eigen::Vector2d(left, height);
  }
  points.col(2 * kSidePoints) = points.col(0);
  return points;
}

}  // namespace

NeckOutline::NeckOutline(const geometry::NeckParameters& neck) {
  for (const geometry::NeckLayer& layer : geometry::layers_of(neck)) {
    layers_.push_back(
        {layer.part, layer.is_rubber,
         rectangle(layer.offset_m - layer.diameter_m / 2, layer.offset_m + layer.diameter_m / 2,
                   layer.bottom_m, layer.bottom_m + layer.thickness_m)});
  }
}

void NeckOutline::deform(const fe_modal::ModalBody& body, const std::vector<Eigen::Index>& modes,
                         const Eigen::VectorXd& coordinates) {
  for (Layer& layer : layers_) {
    for (Eigen::Index k = 0; k < layer.points_m.cols(); ++k) {
      const Eigen::Vector3d point(layer.points_m(0, k), 0, layer.points_m(1, k));
      Eigen::Index nearest = 0;
      (body.nodes_m.colwise() - point).colwise().squaredNorm().minCoeff(&nearest);
      Eigen::Vector3d moved = body.nodes_m.col(nearest);
      for (std::size_t m = 0; m < modes.size(); ++m) {
        const Eigen::Vector3d shape = body.shapes[static_cast<std::size_t>(modes[m])].col(nearest);
        moved += coordinates[static_cast<Eigen::Index>(m)] * shape;
      }
      layer.points_m.col(k) = Eigen::Vector2d(moved.x(), moved.z());
    }
  }
}

std::vector<Drawing::Shape> NeckOutline::shapes(const Eigen::Matrix2d& turn,
                                                const Eigen::Vector2d& shift_in) const {
  const double inch = factor_from_si("m", "in");
  std::vector<Drawing::Shape> shapes;
  for (const Layer& layer : layers_) {
    shapes.push_back({layer.part, (inch * turn * layer.points_m).colwise() + shift_in,
                      layer.is_rubber ? "#b0b8c1" : "#e2e7eb"});
  }
  return shapes;
}

std::vector<Drawing::Shape> NeckOutline::lines(const Eigen::Matrix2d& turn,
                                               const Eigen::Vector2d& shift_in,
                                               const std::string& suffix,
                                               const std::string& style) const {
  std::vector<Drawing::Shape> lines = shapes(turn, shift_in);
  for (Drawing::Shape& line : lines) {
    line.name += suffix;
    line.fill.clear();
    line.line = style;
  }
  return lines;
}

}  // namespace flexneck::pipeline
