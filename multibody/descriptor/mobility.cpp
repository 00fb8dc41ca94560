// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/descriptor/mobility.h"

#include "geometry/foundation/output_file.h"
#include "multibody/numerics/independent_rows.h"

namespace flexneck::multibody {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Fraction of a row independent of the others below which it counts as misalignment: parts are
/// aligned to about half a degree.
constexpr double kAlignment = 1e-2;

/// Calls visit(joint, row of the joint, row among all).
template <class Visit>
void each_row(const EquationsOfMotion& equations, const Visit& visit) {
  for (std::size_t k = 0; k < equations.system().joints.size(); ++k)
    for (Index r = 0; r < equations.joint(k).rows; ++r)
      visit(k, r, equations.solver().joint_offset(k) + r);
}

}  // namespace

MatrixXd free_multipliers(const EquationsOfMotion& equations) {
  const KktSolver& solver = equations.solver();
  std::vector<bool> left_out(static_cast<std::size_t>(solver.constraint_count()), false);
  for (const KktSolver::RedundantRow& each : solver.redundant_rows())
    left_out[static_cast<std::size_t>(solver.joint_offset(each.joint) + each.row)] = true;
  return free_multipliers(solver.rows_in_metres(), left_out);
}

std::string contradictory_motors(const EquationsOfMotion& equations) {
  if (equations.solver().redundant_rows().empty()) return {};
  const MatrixXd free = free_multipliers(equations);
  std::string names;
  int count = 0;
  each_row(equations, [&](std::size_t k, Index r, Index row) {
    if (!is_motor(equations.joint(k), r)) return;
    bool takes_part = false;
    for (Index c = 0; c < free.cols(); ++c)
      takes_part = takes_part || std::abs(free(row, c)) > 1e-7 * free.col(c).norm();
    if (!takes_part) return;
    names += (count++ > 0 ? " and " : "") + name_of_row(equations.joint(k), r);
  });
  if (count == 0) return {};
  if (count == 1)
    return names +
           " prescribes a motion that the joints do not allow; remove it, or use joints with fewer "
           "constraints";
  return names +
         " prescribe the same degree of freedom and contradict each other; keep one of them, or "
         "make them agree";
}

std::vector<std::string> doubts_of_mobility(const EquationsOfMotion& equations) {
  const KktSolver& solver = equations.solver();
  std::vector<std::string> doubts;
  if (solver.constraint_count() == 0) return doubts;
  const VectorXd shares = independent_shares(solver.rows_in_metres());
  bool any_motor = false;
  each_row(equations, [&](std::size_t k, Index r, Index row) {
    any_motor = any_motor || is_motor(equations.joint(k), r);
    if (solver.is_left_out(k, r) || !(shares[row] < kAlignment)) return;
    doubts.push_back("joint '" + equations.system().joints[k].name + "', " +
                     name_of_row(equations.joint(k), r) +
                     ": other joints impose the same constraint except for a misalignment of " +
                     rounded_text(shares[row]) +
                     " (as of axes that are misaligned by this angle in rad). It removes a degree "
                     "of freedom, and its reactions may be large; align the joints (to " +
                     rounded_text(kDependent) + "), or use a joint with fewer constraints");
  });
  const auto redundant = static_cast<Index>(solver.redundant_rows().size());
  if (redundant > 0 && !any_motor &&
      solver.velocity_count() == solver.constraint_count() - redundant)
    doubts.push_back(
        "the model has no degree of freedom left and redundant joint constraints; if it is meant "
        "to move, check the axes of the joints");
  return doubts;
}

}  // namespace flexneck::multibody
