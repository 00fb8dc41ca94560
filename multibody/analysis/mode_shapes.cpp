// SPDX-License-Identifier: GPL-3.0-or-later
// Models linearised about a state: eigenmodes of their coordinates as motions of markers.
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "geometry/foundation/error.h"
#include "multibody/analysis/linearisation.h"
#include "multibody/analysis/steady_rotation.h"
#include "multibody/descriptor/equations_of_motion.h"
#include "multibody/descriptor/equilibrium.h"
#include "multibody/descriptor/initial_state.h"
#include "multibody/descriptor/massless_rotation.h"
#include "multibody/descriptor/reduced_dynamics.h"
#include "multibody/equations/kink.h"
#include "multibody/numerics/rotation.h"
#include "multibody/tree/tree_dynamics.h"
#include "multibody/tree/tree_start.h"

namespace flexneck::multibody {
namespace {

using Eigen::Index;
using Eigen::Matrix3Xcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

/// Extent of the displacements of the finite differences, as in ReducedDynamics.
constexpr double kDifference = 1e-5;
/// Displacement, in m or rad, below which a motion is only an error of the finite differences.
constexpr double kNone = 1e-7;

/// Motion of all markers per unit of each coordinate, (3 markers, coordinates).
struct MarkerMotions {
  MatrixXd translation, rotation;
};

Matrix3Xcd columns(const MatrixXd& per_unit, const VectorXcd& shape) {
  const VectorXcd all = per_unit * shape;
  return Eigen::Map<const Matrix3Xcd>(all.data(), 3, all.size() / 3);
}

std::complex<double> largest_of(const Matrix3Xcd& amplitudes) {
  Index row = 0;
  Index column = 0;
  if (amplitudes.size() == 0) return 0;
  amplitudes.cwiseAbs().maxCoeff(&row, &column);
  return amplitudes(row, column);
}

/// Mode shapes as motions of the markers.
/// @param kink  load with a kink at the state of linearisation; empty if none
std::vector<ModeShape> shapes_of(const std::vector<Eigenmode>& modes, const MarkerMotions& per_unit,
                                 const std::string& kink) {
  std::vector<ModeShape> shapes;
  const Index markers = per_unit.translation.rows() / 3;
  for (const Eigenmode& each : modes) {
    ModeShape shape{each.mode, Matrix3Xcd::Zero(3, markers), Matrix3Xcd::Zero(3, markers)};
    if (each.shape.size() > 0) {
      shape.translation = columns(per_unit.translation, each.shape);
      shape.rotation = columns(per_unit.rotation, each.shape);
      std::complex<double> unit = largest_of(shape.translation);
      const std::complex<double> turn = largest_of(shape.rotation);
      if (std::abs(unit) <= kNone * std::abs(turn)) unit = turn;
      if (std::abs(unit) > 0) {
        shape.translation /= unit;
        shape.rotation /= unit;
      }
    }
    shape.mode.kink = kink;
    shapes.push_back(std::move(shape));
  }
  return shapes;
}

/// Linearises any model at rest relative to a frame, in the independent coordinates of all bodies.
std::vector<ModeShape> linearise_at_rest(EquationsOfMotion& equations, const VectorXd& positions,
                                         const TurningFrame& frame = {}) {
  const System& system = equations.system();
  ReducedDynamics reduced(equations, positions, 0, frame);
  const std::vector<Eigenmode> modes =
      eigenmodes_of(reduced.state_matrix(), reduced.count(), system.internal_count);
  equations.set_positions(0, positions);
  const VectorXd still = VectorXd::Zero(system.velocity_count);
  equations.set_velocities(still);
  equations.update_idle_markers(still);
  const auto markers = static_cast<Index>(system.markers.size());
  MarkerMotions motions{MatrixXd::Zero(3 * markers, reduced.count()),
                        MatrixXd::Zero(3 * markers, reduced.count())};
  for (Index k = 0; k < markers; ++k) {
    const auto index = static_cast<std::size_t>(k);
    const std::size_t b = system.markers[index].free_body;
    if (b == JointPlace::kNoBody) continue;
    const NodeKinematics& node = equations.marker(index);
    const auto basis = reduced.basis().middleRows(system.bodies[b].velocity, node.P.cols());
    motions.translation.middleRows<3>(3 * k) = node.P * basis;
    motions.rotation.middleRows<3>(3 * k) = node.W * basis;
  }
  return shapes_of(modes, motions, reduced.kink());
}

/// Linearises trees in motion, by finite differences of their state's rate.
class TreeLinearisation {
 public:
  explicit TreeLinearisation(const Model& model)
      : tree_(model), dynamics_(tree_), state_(tree::given_state(tree_)) {
    dynamics_.update(0, state_);
    tree_.internal(state_) = dynamics_.forces().internal();
  }

  std::vector<ModeShape> modes() {
    const Index n = tree_.position_count + tree_.velocity_count + tree_.internal_count;
    MatrixXd A(n, n);
    std::string kink;
    const VectorXd there = rate_at(0, 0).head(n);
    for (Index i = 0; i < n; ++i) {
      const double step = kDifference * std::max(1.0, std::abs(state_[i]));
      const auto side = [&](double distance) -> RatesAndPieces {
        RatesAndPieces result{rate_at(i, distance).head(n), dynamics_.forces().pieces(), {}};
        for (std::size_t b = 0; b < tree_.bodies.size(); ++b)
          if (const ModalSprings& springs = tree_.bodies[b].inertia.springs;
              springs.gaps.count() > 0)
            result.slits.emplace_back(tree_.bodies[b].name, springs, dynamics_.modal(b));
        return result;
      };
      const RatesAndPieces ahead = side(step);
      const RatesAndPieces behind = side(-step);
      A.col(i) = (ahead.rates - behind.rates) / (2 * step);
      if (kink.empty()) kink = kink_between(dynamics_.forces(), ahead, there, behind);
    }
    return shapes_of(eigenmodes_of(A, tree_.position_count, tree_.internal_count), marker_motions(),
                     kink);
  }

 private:
  VectorXd rate_at(Index component, double step) {
    VectorXd moved = state_;
    moved[component] += step;
    VectorXd rate(moved.size());
    dynamics_.evaluate(0, moved, rate);
    return rate;
  }

  std::vector<MarkerState> markers_at(Index component, double step) {
    rate_at(component, step);
    std::vector<MarkerState> markers;
    for (std::size_t k = 0; k < tree_.markers.size(); ++k)
      dynamics_.marker_state(k, markers.emplace_back());
    return markers;
  }

  MarkerMotions marker_motions() {
    const auto markers = static_cast<Index>(tree_.markers.size());
    MarkerMotions motions{MatrixXd(3 * markers, tree_.position_count),
                          MatrixXd(3 * markers, tree_.position_count)};
    for (Index i = 0; i < tree_.position_count; ++i) {
      const auto ahead = markers_at(i, kDifference);
      const auto behind = markers_at(i, -kDifference);
      for (Index k = 0; k < markers; ++k) {
        const auto at = static_cast<std::size_t>(k);
        motions.translation.col(i).segment<3>(3 * k) =
            (ahead[at].position_m - behind[at].position_m) / (2 * kDifference);
        motions.rotation.col(i).segment<3>(3 * k) =
            rotation_log(ahead[at].rotation * behind[at].rotation.transpose()) / (2 * kDifference);
      }
    }
    return motions;
  }

  tree::Tree tree_;
  tree::TreeDynamics dynamics_;
  VectorXd state_;
};

/// Returns whether nothing moves at time zero.
bool is_still(const Model& model) {
  for (const Body& body : model.bodies) {
    Eigen::Vector3d v = body.initial_velocity_m_s;
    Eigen::Vector3d w = body.initial_angular_velocity_rad_s;
    if (const auto* prescribed = std::get_if<PrescribedBody>(&body.kind)) {
      const PrescribedMotion motion = PrescribedPath(body.initial_pose, *prescribed).at(0);
      v = motion.velocity_m_s;
      w = motion.angular_velocity_rad_s;
    }
    if (!v.isZero(0) || !w.isZero(0)) return false;
  }
  return true;
}

}  // namespace

std::vector<ModeShape> linearise(const Model& model, LinearisedAt at) {
  check(model);
  check_massless_rotations(model);
  if (at == LinearisedAt::given && tree::is_tree(model)) return TreeLinearisation(model).modes();
  if (at == LinearisedAt::given && !is_still(model))
    throw InputError(
        "a moving model with closed loops of joints cannot be linearised; remove the initial "
        "velocities, or linearise about the equilibrium");
  const System system(model);
  EquationsOfMotion held(system, Drive::held);
  if (at == LinearisedAt::equilibrium) {
    if (const std::optional<TurningFrame> frame = steady_rotation(model)) {
      EquationsOfMotion turning(system);
      const VectorXd given = given_positions(model, turning);
      return linearise_at_rest(turning, rotating_positions(turning, *frame, given), *frame);
    }
    return linearise_at_rest(held, equilibrium_positions(model, held));
  }
  return linearise_at_rest(held, given_positions(model, held));
}

std::vector<SystemMode> system_modes(const Model& model) {
  std::vector<SystemMode> modes;
  for (const ModeShape& each : linearise(model, LinearisedAt::equilibrium))
    modes.push_back(each.mode);
  return modes;
}

}  // namespace flexneck::multibody
