// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/analysis/campbell.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "geometry/foundation/error.h"
#include "multibody/analysis/linearisation.h"
#include "multibody/analysis/steady_rotation.h"
#include "multibody/descriptor/initial_state.h"
#include "multibody/descriptor/massless_rotation.h"

namespace flexneck::multibody {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;
using SparseMatrix = Eigen::SparseMatrix<double>;

/// The model with the rates of its rotating prescribed bodies multiplied.
Model at_rate(Model model, double factor) {
  for (Body& body : model.bodies)
    if (auto* prescribed = std::get_if<PrescribedBody>(&body.kind))
      prescribed->turn.initial_rate_rad_s *= factor;
  return model;
}

/// The modes at one rate.
struct ModesAtRate {
  double rate_Hz;
  std::vector<SystemMode> modes;
  /// Velocities of all bodies, of unit norm in the mass metric; empty without restoring force.
  std::vector<VectorXcd> shapes;
  /// Frequency with the sign of the eigenvalue, of each conjugate pair, that has the shape: it
  /// changes when a whirl is followed through zero.
  std::vector<double> signed_Hz;
  SparseMatrix mass;
  VectorXd positions;
};

ModesAtRate modes_at(const Model& model, const TurningFrame& frame, const ModesAtRate* before) {
  const System system(model);
  EquationsOfMotion equations(system);
  const VectorXd start = before != nullptr ? before->positions : given_positions(model, equations);
  ModesAtRate found;
  found.rate_Hz = frame.rate_rad_s.norm() / (2 * std::numbers::pi);
  found.positions = rotating_positions(equations, frame, start);
  ReducedDynamics reduced(equations, found.positions, 0, frame);
  found.mass.resize(system.velocity_count, system.velocity_count);
  assemble_mass(equations, found.mass);
  const std::vector<Eigenmode> modes =
      eigenmodes_of(second_order(reduced.stiffness(), reduced.damping()), reduced.count());
  for (const Eigenmode& each : modes) {
    found.modes.push_back(each.mode);
    found.modes.back().kink = reduced.kink();
    found.signed_Hz.push_back(each.mode.frequency_Hz);
    // The basis is orthonormal in the mass metric.
    found.shapes.push_back(
        each.shape.size() > 0 ? VectorXcd(reduced.basis() * each.shape.normalized()) : VectorXcd());
  }
  return found;
}

/// Modal assurance criterion of two shapes of unit norm, from 0 to 1.
double assurance(const VectorXcd& a, const VectorXcd& b, const SparseMatrix& mass) {
  return a.size() == 0 || b.size() == 0 ? 0 : std::norm(a.dot(mass * b));
}

/// Reorders the modes at a rate so that each continues one of the modes before, and conjugates
/// those whose frequency has changed its sign. The shape decides, and the frequency among similar
/// shapes.
ModesAtRate continued(const ModesAtRate& before, const ModesAtRate& after) {
  const auto n = static_cast<Index>(before.modes.size());
  const auto likeness = [&](Index a, Index b, bool turned_over) {
    const auto i = static_cast<std::size_t>(a);
    const auto j = static_cast<std::size_t>(b);
    const double f = before.signed_Hz[i];
    const double g = turned_over ? -after.signed_Hz[j] : after.signed_Hz[j];
    const double scale = std::abs(f) + std::abs(g) + after.rate_Hz;
    const VectorXcd shape = turned_over ? after.shapes[j].conjugate() : after.shapes[j];
    return assurance(before.shapes[i], shape, before.mass) -
           (scale > 0 ? std::abs(f - g) / scale : 0);
  };
  MatrixXd best(n, n);
  for (Index a = 0; a < n; ++a)
    for (Index b = 0; b < n; ++b)
      best(a, b) = std::max(likeness(a, b, false), likeness(a, b, true));
  ModesAtRate ordered = after;
  for (Index k = 0; k < n; ++k) {
    Index a = 0;
    Index b = 0;
    best.maxCoeff(&a, &b);
    const auto i = static_cast<std::size_t>(a);
    const auto j = static_cast<std::size_t>(b);
    const bool turned_over = likeness(a, b, true) > likeness(a, b, false);
    ordered.modes[i] = after.modes[j];
    ordered.shapes[i] = turned_over ? VectorXcd(after.shapes[j].conjugate()) : after.shapes[j];
    ordered.signed_Hz[i] = (turned_over ? -1 : 1) * after.signed_Hz[j];
    best.row(a).setConstant(-10);
    best.col(b).setConstant(-10);
  }
  return ordered;
}

}  // namespace

CampbellDiagram campbell_diagram(const Model& model, const std::vector<double>& rates_rad_s) {
  check(model);
  check_massless_rotations(model);
  const std::optional<TurningFrame> own = steady_rotation(model);
  if (!own)
    throw InputError(
        "a Campbell diagram needs a prescribed body that rotates at time zero, found none; set its "
        "initial_rate, which gives the axis and sense of rotation");
  for (std::size_t r = 0; r < rates_rad_s.size(); ++r)
    if (!(rates_rad_s[r] >= 0 && (r == 0 || rates_rad_s[r] > rates_rad_s[r - 1])))
      throw InputError("the rates of a Campbell diagram must be ascending and not negative");
  CampbellDiagram diagram{rates_rad_s, {}};
  std::optional<ModesAtRate> before;
  for (const double rate : rates_rad_s) {
    const double factor = rate / own->rate_rad_s.norm();
    ModesAtRate found = modes_at(at_rate(model, factor), {factor * own->rate_rad_s, own->point_m},
                                 before ? &*before : nullptr);
    if (before) found = continued(*before, found);
    diagram.modes.resize(found.modes.size());
    for (std::size_t k = 0; k < found.modes.size(); ++k) diagram.modes[k].push_back(found.modes[k]);
    before = std::move(found);
  }
  return diagram;
}

}  // namespace flexneck::multibody
