// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/exchange/exudyn_file.h"

#include <array>
#include <cmath>
#include <numbers>

#include "fe_modal/body/skew.h"
#include "geometry/foundation/hdf5_dictionary.h"

namespace flexneck::fe_modal {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;

/// Corners of a tetrahedron about the interface: its position is their mean.
const std::array<Vector3d, 4> kCorners = {Vector3d(1, 1, 1), Vector3d(1, -1, -1),
                                          Vector3d(-1, 1, -1), Vector3d(-1, -1, 1)};

void write(Hdf5Dictionary& file, const std::string& key, const MatrixXd& matrix) {
  const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> rows = matrix;
  file.array(key, {rows.data(), static_cast<std::size_t>(rows.size())},
             {static_cast<std::size_t>(rows.rows()), static_cast<std::size_t>(rows.cols())});
}

void write_vector(Hdf5Dictionary& file, const std::string& key, const Eigen::VectorXd& values) {
  const auto size = static_cast<std::size_t>(values.size());
  file.array(key, {values.data(), size}, {size});
}

/// Positions of all nodes, one below the other, and their shapes, a column for each mode.
struct Nodes {
  Eigen::VectorXd positions;
  MatrixXd shapes;
};

Nodes nodes_of(const ModalBody& body) {
  const Index n = body.nodes_m.cols();
  const auto corners = static_cast<Index>(kCorners.size());
  const Index all = n + corners * static_cast<Index>(body.interfaces.size());
  const Index m = body.mode_count();
  Nodes nodes{Eigen::VectorXd(3 * all), MatrixXd(3 * all, m)};
  nodes.positions.head(3 * n) = body.nodes_m.reshaped();
  for (Index k = 0; k < m; ++k)
    nodes.shapes.col(k).head(3 * n) = body.shapes[static_cast<std::size_t>(k)].reshaped();
  // The corners are about as far apart as the nodes of a mesh; any distance would do.
  const double size = std::sqrt((body.nodes_m.colwise() - body.nodes_m.rowwise().mean().eval())
                                    .colwise()
                                    .squaredNorm()
                                    .mean());
  const double distance = size > 0 ? 0.01 * size : 0.01;
  Index row = 3 * n;
  for (const Interface& interface : body.interfaces) {
    for (const Vector3d& corner : kCorners) {
      const Vector3d arm = distance * corner;
      nodes.positions.segment<3>(row) = interface.position_m + arm;
      nodes.shapes.middleRows<3>(row) = interface.translation - skew(arm) * interface.rotation;
      row += 3;
    }
  }
  return nodes;
}

/// Writes the inertia integrals: products of the modes and of their skew matrices ~psi_j, side by
/// side, with one another and with the positions, integrated over the mass.
void write_inertia(Hdf5Dictionary& file, const InertiaInvariants& inertia) {
  const Index m = inertia.Maa.rows();
  MatrixXd psi_psi(3 * m, m), psi_skew(3 * m, 3 * m), translation_skew(3, 3 * m),
      position_skew(3, 3 * m);
  for (Index j = 0; j < m; ++j) {
    translation_skew.middleCols<3>(3 * j) = skew(Vector3d(inertia.S2.col(j)));
    position_skew.middleCols<3>(3 * j) = inertia.G0[static_cast<std::size_t>(j)];
    for (Index l = 0; l < m; ++l) {
      const auto pair = static_cast<std::size_t>(j * m + l);
      psi_psi.block<3, 1>(3 * j, l) = -inertia.N[pair];
      psi_skew.block<3, 3>(3 * j, 3 * l) = inertia.G[pair];
    }
  }
  const Vector3d center = inertia.S1 / inertia.mass;
  write(file, "inertiaLocal", inertia.J0);
  write(file, "Mtt", inertia.mass * Matrix3d::Identity());
  file.real("totalMass", inertia.mass);
  write_vector(file, "chiU", center);
  write(file, "chiUtilde", skew(center));
  write(file, "mPsiTildePsi", psi_psi);
  write(file, "mPsiTildePsiTilde", psi_skew);
  write(file, "mPhitTPsi", inertia.S2);
  write(file, "mPhitTPsiTilde", translation_skew);
  write(file, "mXRefTildePsi", -inertia.N0);
  write(file, "mXRefTildePsiTilde", position_skew);
}

}  // namespace

void write_exudyn(const std::filesystem::path& path, const ModalBody& body) {
  // Coordinates of the nodes with Euler parameters that ObjectFFRFreducedOrderInterface makes by
  // default.
  constexpr std::int32_t kRotations = 4, kDimension = 3;
  const Nodes nodes = nodes_of(body);
  const Eigen::VectorXd omega = 2 * std::numbers::pi * body.frequencies_Hz;
  const auto m = static_cast<std::int32_t>(body.mode_count());
  const std::array<std::int32_t, 6> extents = {
      m,
      static_cast<std::int32_t>(nodes.positions.size() / 3),
      kDimension,
      kRotations,
      kDimension + kRotations,
      kDimension + kRotations + m};
  Hdf5Dictionary file(path);
  file.text("type", "ObjectFFRFreducedOrderInterface");
  file.integer("fileVersion", 1);
  write(file, "modeBasis", nodes.shapes);
  file.array("trigList", std::span<const std::int32_t>(), {0, 3});
  file.empty_dictionary("postProcessingModes");
  write(file, "massMatrixReduced", body.invariants.Maa);
  write(file, "stiffnessMatrixReduced", omega.cwiseAbs2().asDiagonal());
  file.array("infoList", extents, {extents.size()});
  file.text("rigidBodyNodeType", "NodeType.RotationEulerParameters");
  write_vector(file, "xRef", nodes.positions);
  write_inertia(file, body.invariants);
  file.commit();
}

}  // namespace flexneck::fe_modal
