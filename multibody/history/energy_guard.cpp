// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/history/energy_guard.h"

#include <algorithm>
#include <cmath>

#include "geometry/foundation/error.h"
#include "geometry/foundation/output_file.h"

namespace flexneck::multibody {
namespace {

constexpr double kTold = 1e-3;
constexpr double kStopped = 1e-1;
constexpr int kWrongSteps = 20;
/// Bound of slow speeds in m/s as a multiple of the absolute tolerance: at speeds below it some
/// hundred steps, each with an error of the tolerance, change the energy by more than the warning
/// limit.
constexpr double kSlow = 1e5;
/// The same multiple of the relative tolerance for speeds relative to a prescribed body: a body
/// that stays in place while its base moves has no energy but that of errors.
constexpr double kSteps = 1e5;
/// Fraction of energies that are large compared with their changes, such as that of a high
/// position: their rounding is a thousandth of it.
constexpr double kDigits = 1e-10;
constexpr int kDigitsOfTime = 9;

double mass_kg(const Body& body) {
  if (const auto* rigid = std::get_if<RigidBody>(&body.kind)) return rigid->mass_kg;
  const auto* deformable = std::get_if<DeformableBody>(&body.kind);
  return deformable == nullptr ? 0 : deformable->modes.invariants.mass;
}

}  // namespace

EnergyGuard::EnergyGuard(const Model& model, Tolerance tolerance) {
  double mass = 0;
  for (const Body& body : model.bodies) mass += mass_kg(body);
  const double slow_m_s = kSlow * tolerance.absolute;
  floor_J_ = mass / 2 * slow_m_s * slow_m_s;
  carried_share_ = std::pow(std::min(1.0, kSteps * tolerance.relative), 2);
}

double EnergyGuard::see(double time_s, const Energies& stored, double dissipated_J, double work_J) {
  const double balance_J =
      stored.kinetic_J + stored.gravitational_J + stored.strain_J + dissipated_J - work_J;
  EnergyBooks& books = books_;
  if (!books.are_open)
    books = {.are_open = true,
             .first_balance_J = balance_J,
             .first_gravitational_J = stored.gravitational_J,
             .first_dissipated_J = dissipated_J,
             .first_work_J = work_J,
             .largest_J = floor_J_};
  books.largest_J = std::max(
      {books.largest_J, stored.kinetic_J, carried_share_ * stored.carried_J,
       std::abs(stored.strain_J), std::abs(stored.gravitational_J - books.first_gravitational_J),
       std::abs(dissipated_J - books.first_dissipated_J), std::abs(work_J - books.first_work_J),
       kDigits * std::abs(stored.gravitational_J), kDigits * std::abs(work_J)});
  const double off_J = balance_J - books.first_balance_J;
  // A balance that is NaN deviates by more than any number.
  if (!(std::abs(off_J) <= books.worst_J)) books.worst_J = std::abs(off_J);
  const bool departs = !(books.worst_J <= kTold * books.largest_J);
  if (departs && !books.departs) books.departs_at_s = time_s;
  books.departs = departs;
  return off_J;
}

void EnergyGuard::check(double time_s, const Energies& stored, double dissipated_J, double work_J) {
  const double off_J = see(time_s, stored, dissipated_J, work_J);
  EnergyBooks& books = books_;
  const bool is_wrong = !(std::abs(off_J) <= kStopped * books.largest_J);
  books.wrong_steps = is_wrong ? books.wrong_steps + 1 : 0;
  if (books.wrong_steps < kWrongSteps) return;
  throw ComputationError("the energy balance is violated: " + rounded_text(std::abs(off_J), 3) +
                         " J, " + rounded_text(100 * std::abs(off_J) / books.largest_J, 3) +
                         " % of the largest energy of the run, are " +
                         (off_J < 0 ? "lost" : "gained") + " at " +
                         rounded_text(time_s, kDigitsOfTime) + " s, and the deviation begins at " +
                         rounded_text(books.departs_at_s, kDigitsOfTime) +
                         " s; further results would be wrong. Reduce the tolerances or max_step, "
                         "or use the integrator dormand_prince");
}

std::vector<std::string> EnergyGuard::warnings() const {
  if (!books_.departs) return {};
  return {"the energy balance deviates from " + rounded_text(books_.departs_at_s, kDigitsOfTime) +
          " s on: up to " + rounded_text(100 * books_.worst_J / books_.largest_J, 3) +
          " % of the largest energy of the run are lost or gained by time steps; reduce the "
          "tolerances or max_step, or use the integrator dormand_prince"};
}

}  // namespace flexneck::multibody
