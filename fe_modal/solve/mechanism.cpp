// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/solve/mechanism.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include <Eigen/Geometry>
#include <Eigen/SVD>

#include "fe_modal/algebra/matrix_product.h"
#include "fe_modal/algebra/operator_matrix.h"
#include "fe_modal/solve/eigensolver.h"
#include "fe_modal/system/rigid_average.h"
#include "geometry/foundation/output_file.h"
#include "mesher/mesh/bounding_box.h"
#include "mesher/mesh/positions.h"

namespace flexneck::fe_modal {
namespace {

/// Largest number of strainless motions that are looked for: two bodies without supports have
/// twelve.
constexpr Eigen::Index kMaxMotions = 12;
/// Fraction of the largest value below which a singular value, or a deviation from a rigid motion,
/// is zero.
constexpr double kNone = 1e-3;

using Motions = Eigen::Matrix<double, 6, Eigen::Dynamic>;

/// Fields on all nodes without strain energy, (3 n, their number).
Eigen::MatrixXd strainless_fields(const AssembledSystem& system) {
  const std::unique_ptr<const LinearSolver> inverse =
      shift_inverse(system, -eigenvalue_scale(system.model().mesh()));
  const DofMap& dof_map = system.fields().dof_map();
  const Eigen::Index dofs = dof_map.dof_count() - dof_map.dependent_count();
  const EigenPairs pairs = lowest_eigenpairs(system.mass(), *inverse, std::min(kMaxMotions, dofs));
  const Eigen::Index count = are_strainless(system, pairs.vectors).count();
  Eigen::MatrixXd fields(3 * system.fields().node_count(), count);
  const auto expanded = system.fields().expand(pairs.vectors.leftCols(count));
  for (Eigen::Index k = 0; k < count; ++k) {
    fields.col(k) = expanded[static_cast<std::size_t>(k)].reshaped();
  }
  return fields;
}

struct Part {
  std::string name;
  RigidAverage average;
  std::vector<std::int32_t> nodes;
};

std::vector<Part> rigid_parts_of(const mesher::Mesh& mesh) {
  std::vector<Part> parts;
  for (const mesher::ElementBlock& block : mesh.blocks) {
    auto part = std::find_if(parts.begin(), parts.end(),
                             [&](const Part& known) { return known.name == block.part; });
    if (part == parts.end()) {
      part = parts.insert(part, {block.part, RigidAverage(mesh, block.part), {}});
    }
    part->nodes.insert(part->nodes.end(), block.nodes.begin(), block.nodes.end());
  }
  return parts;
}

/// Rigid motion of a part in each field; rotations as lengths at the distance `length_m`.
Motions motions_of(const Part& part, const Eigen::MatrixXd& fields, double length_m) {
  Motions motions(6, fields.cols());
  for (Eigen::Index k = 0; k < fields.cols(); ++k) {
    motions.col(k) = part.average.of(
        Eigen::Map<const Eigen::Matrix3Xd>(fields.col(k).data(), 3, fields.rows() / 3));
  }
  motions.bottomRows<3>() *= length_m;
  return motions;
}

/// Combinations of the fields in which the heaviest part does not move.
Eigen::MatrixXd without_motion_as_a_whole(const std::vector<Part>& parts,
                                          const Eigen::MatrixXd& fields, double length_m) {
  const auto heaviest =
      std::max_element(parts.begin(), parts.end(), [](const Part& one, const Part& other) {
        return one.average.gram()(0, 0) < other.average.gram()(0, 0);
      });
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(motions_of(*heaviest, fields, length_m),
                                              Eigen::ComputeFullV);
  const Eigen::VectorXd& values = svd.singularValues();
  const Eigen::Index rank = (values.array() > kNone * values[0]).count();
  return fields * svd.matrixV().rightCols(fields.cols() - rank);
}

/// Largest deviation of the part's nodes from rigid motion, over the field's largest displacement.
double deformation(const mesher::Mesh& mesh, const Part& part, const Eigen::VectorXd& field) {
  const Eigen::Map<const Eigen::Matrix3Xd> displacement(field.data(), 3, field.size() / 3);
  const Vector6d motion = part.average.of(displacement);
  const auto positions = mesher::positions_of(mesh);
  double deviation = 0;
  for (const std::int32_t node : part.nodes) {
    const Eigen::Vector3d arm = positions.col(node) - part.average.point_m();
    const Eigen::Vector3d rigid = motion.head<3>() + motion.tail<3>().cross(arm);
    deviation = std::max(deviation, (displacement.col(node) - rigid).norm());
  }
  return deviation / displacement.colwise().norm().maxCoeff();
}

/// Name of a direction: "z", or "(0.71, 0.71, 0)".
std::string direction_name(Eigen::Vector3d direction) {
  Eigen::Index largest = 0;
  direction.cwiseAbs().maxCoeff(&largest);
  if (direction[largest] < 0) direction = -direction;
  if (direction[largest] > 1 - kNone) return std::string(1, "xyz"[largest]);
  return "(" + fixed_text(direction[0], 2) + ", " + fixed_text(direction[1], 2) + ", " +
         fixed_text(direction[2], 2) + ")";
}

/// Describes the motion of a part.
/// @param motion the only one that the part has; rotation as a length
std::string describe_motion(const Part& part, Vector6d motion, double length_m) {
  motion.tail<3>() /= length_m;
  const Eigen::Vector3d translation = motion.head<3>();
  const Eigen::Vector3d rotation = motion.tail<3>();
  if (rotation.norm() * length_m < kNone * translation.norm()) {
    return "slides freely along " + direction_name(translation.normalized());
  }
  // The point of the axis nearest to the part's centre does not move across the axis.
  const Eigen::Vector3d axis = rotation.normalized();
  const Eigen::Vector3d to_axis = rotation.cross(translation) / rotation.squaredNorm();
  Eigen::Vector3d foot = part.average.point_m() + to_axis;
  foot -= axis * axis.dot(foot);  // the foot is the same for all parts that rotate together
  const double rounding = kNone * length_m;
  foot = foot.unaryExpr([&](double x) { return std::abs(x) < rounding ? 0.0 : x; });
  return "rotates freely about " + direction_name(axis) + " through (" +
         rounded_texts({foot.data(), 3}, 3) + ") m";
}

/// Description of a part's motion; nothing if it does not move.
std::optional<std::string> describe_part(const Part& part, const Eigen::MatrixXd& fields,
                                         double length_m) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(motions_of(part, fields, length_m),
                                              Eigen::ComputeThinU);
  const double whole = fields.cwiseAbs().maxCoeff();
  const Eigen::Index ways = (svd.singularValues().array() > kNone * whole).count();
  if (ways == 0) return std::nullopt;
  if (ways == 6) return "is not fixed: it can move freely in all six degrees of freedom";
  if (ways > 1) return "moves freely in " + std::to_string(ways) + " independent ways";
  return describe_motion(part, svd.matrixU().col(0), length_m);
}

}  // namespace

double eigenvalue_scale(const mesher::Mesh& mesh) {
  double slowest = HUGE_VAL;
  for (const mesher::ElementBlock& block : mesh.blocks) {
    const mesher::Material& material = mesh.materials.at(block.material);
    slowest = std::min(slowest, material.youngs_modulus_Pa / material.density_kg_m3);
  }
  return slowest / mesher::bounding_box(mesh).extent_m().squaredNorm();
}

Eigen::Array<bool, Eigen::Dynamic, 1> are_strainless(const ModalSystem& system,
                                                     const Eigen::MatrixXd& motions) {
  constexpr const char* kAsking = "searching for motions without strain";
  constexpr double kLost = 10 * std::numeric_limits<double>::epsilon();
  VecHandle diagonal;
  require(MatCreateVecs(system.stiffness(), diagonal.out(), nullptr), kAsking);
  require(MatGetDiagonal(system.stiffness(), diagonal.get()), kAsking);
  const Eigen::MatrixXd forces = block_product(system.stiffness(), motions);
  const Eigen::ArrayXd energies = column_products(system.ranks(), motions, forces);
  const double* entries = nullptr;
  require(VecGetArrayRead(diagonal.get(), &entries), kAsking);
  const Eigen::MatrixXd alone =
      Eigen::Map<const Eigen::VectorXd>(entries, motions.rows()).asDiagonal() * motions;
  require(VecRestoreArrayRead(diagonal.get(), &entries), kAsking);
  return energies <= kLost * column_products(system.ranks(), motions, alone).array();
}

std::optional<std::string> describe_mechanism(const AssembledSystem& system, bool is_fixed) {
  const mesher::Mesh& mesh = system.model().mesh();
  const double length_m = mesher::bounding_box(mesh).extent_m().norm();
  const std::vector<Part> parts = rigid_parts_of(mesh);
  Eigen::MatrixXd fields = strainless_fields(system);
  if (!is_fixed && fields.cols() > 0) fields = without_motion_as_a_whole(parts, fields, length_m);
  std::string text;
  for (const Part& part : parts) {
    const auto motion = fields.cols() == 0 ? std::nullopt : describe_part(part, fields, length_m);
    if (!motion) continue;
    for (const auto& field : fields.colwise()) {
      if (deformation(mesh, part, field) > kNone) return std::nullopt;
    }
    text += (text.empty() ? "part '" : "; part '") + part.name + "' " + *motion;
  }
  return text.empty() ? std::nullopt : std::optional(text);
}

}  // namespace flexneck::fe_modal
