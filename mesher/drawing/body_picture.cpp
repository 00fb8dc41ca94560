// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/drawing/body_picture.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "geometry/foundation/error.h"
#include "mesher/drawing/colours.h"
#include "mesher/mesh/positions.h"

namespace flexneck::mesher {
namespace {

const Colour kBackground(1, 1, 1);
const Colour kEdges(0.13F, 0.15F, 0.18F);
const Colour kGhost(0.68F, 0.70F, 0.74F);
constexpr double kMargin = 0.05;  ///< fraction of the picture, on each side

/// Turns points of the body into points of the picture.
class Projection {
 public:
  Projection(const Eigen::MatrixX3d& nodes, const View& view, int width, int height,
             double room_m) {
    const Eigen::Vector3d eye = view.towards_eye.normalized();
    const Eigen::Vector3d right = Eigen::Vector3d::UnitZ().cross(eye).normalized();
    axes_.row(0) = right;
    axes_.row(1) = -eye.cross(right);
    axes_.row(2) = eye;
    const Eigen::MatrixX3d turned = nodes * axes_.transpose();
    const Eigen::Vector3d low = turned.colwise().minCoeff().transpose().array() - room_m;
    const Eigen::Vector3d high = turned.colwise().maxCoeff().transpose().array() + room_m;
    pixels_per_m_ =
        (1 - 2 * kMargin) * std::min(width / (high.x() - low.x()), height / (high.y() - low.y()));
    shift_ = Eigen::Vector3d(width / 2.0, height / 2.0, 0) - pixels_per_m_ * (low + high) / 2;
  }

  Eigen::MatrixX3d operator()(const Eigen::MatrixX3d& positions) const {
    return (pixels_per_m_ * positions * axes_.transpose()).rowwise() + shift_.transpose();
  }
  const Eigen::Matrix3d& axes() const { return axes_; }

 private:
  Eigen::Matrix3d axes_;  ///< rows: right, down, towards the eye
  double pixels_per_m_ = 1;
  Eigen::Vector3d shift_;
};

/// Brightness of a face, seen from either side, lit from over the viewer's left shoulder.
double brightness(const Eigen::Vector3d& normal, const Eigen::Matrix3d& axes) {
  const Eigen::Vector3d light = (axes.transpose() * Eigen::Vector3d(-0.35, -0.5, 0.8)).normalized();
  return 0.38 + 0.62 * std::abs(normal.dot(light));
}

std::vector<Colour> vertex_colours(const Mesh& mesh, const Surface& surface,
                                   const BodyPicture& what, const Eigen::MatrixX3d& moved,
                                   const Eigen::Matrix3d& axes) {
  const Eigen::MatrixX3d along_xi = surface.along_xi * moved;
  const Eigen::MatrixX3d along_eta = surface.along_eta * moved;
  Eigen::VectorXd field;
  if (what.field.size() > 0) field = surface.value * what.field;
  std::vector<Colour> colours;
  colours.reserve(surface.block_of_vertex.size());
  for (Eigen::Index v = 0; v < along_xi.rows(); ++v) {
    const Eigen::Vector3d normal =
        along_xi.row(v).transpose().cross(along_eta.row(v).transpose()).normalized();
    const ElementBlock& block = mesh.blocks[surface.block_of_vertex[static_cast<std::size_t>(v)]];
    const Colour colour =
        field.size() > 0 ? scale_colour(field[v]) : category_colour(block.material);
    colours.push_back(static_cast<float>(brightness(normal, axes)) * colour);
  }
  return colours;
}

void draw_chains(const std::vector<std::vector<std::int32_t>>& chains,
                 const Eigen::MatrixX3d& points, const Colour& colour, double width, double lift,
                 Raster& raster) {
  for (const auto& chain : chains) {
    for (std::size_t i = 1; i < chain.size(); ++i) {
      raster.draw_line(points.row(chain[i - 1]), points.row(chain[i]), colour, width, lift);
    }
  }
}

}  // namespace

Raster draw_body(const Mesh& mesh, const Surface& surface, const BodyPicture& what,
                 const View& view, int width, int height, double room_m) {
  Raster raster(width, height, kBackground);
  const Eigen::MatrixX3d nodes = positions_of(mesh).transpose();
  const Projection project(nodes, view, width, height, room_m);
  if (what.undeformed_outline) {
    // The outline lies far behind everything, so that the body hides it.
    Eigen::MatrixX3d outline = project(surface.value * nodes);
    outline.col(2).setConstant(-1e9);
    draw_chains(surface.outlines, outline, kGhost, 1, 0, raster);
  }
  const bool moves = what.displacement_m.size() > 0;
  const Eigen::MatrixX3d moved =
      moves ? Eigen::MatrixX3d(nodes + what.displacement_m.transpose()) : nodes;
  const Eigen::MatrixX3d points = project(surface.value * moved);
  if (!points.allFinite() || !what.field.allFinite())
    throw ComputationError("a picture of a body needs finite positions and values");
  const std::vector<Colour> colours = vertex_colours(mesh, surface, what, moved, project.axes());
  for (const auto& triangle : surface.triangles) {
    std::array<ScreenPoint, 3> corners;
    std::array<Colour, 3> shades;
    for (std::size_t c = 0; c < 3; ++c) {
      corners[c] = points.row(triangle[c]);
      shades[c] = colours[static_cast<std::size_t>(triangle[c])];
    }
    raster.draw_triangle(corners, shades);
  }
  draw_chains(what.element_edges ? surface.edges : surface.outlines, points, kEdges, 0.67, 1.5,
              raster);
  return raster;
}

}  // namespace flexneck::mesher
