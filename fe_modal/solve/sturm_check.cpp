// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/solve/sturm_check.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "fe_modal/solve/inertia.h"
#include "fe_modal/system/assembly.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/output_file.h"

namespace flexneck::fe_modal {
namespace {

/// Relative difference of neighbouring eigenvalues below which they belong to one cluster: 0.05 %
/// in frequency, more than the uncertainty of an eigenvalue that only serves as the next one, and
/// than the difference that the mesh of a symmetric body may cause.
constexpr double kCluster = 1e-3;
/// Fraction of the shift below which eigenvalues are rigid-body motions.
constexpr double kRigidBody = 1e-6;

std::string hertz(double eigenvalue) {
  return rounded_text(std::sqrt(std::max(eigenvalue, 0.0)) / (2 * std::numbers::pi)) + " Hz";
}

bool is_rigid(double eigenvalue, double shift) {
  return eigenvalue <= kRigidBody * std::abs(shift);
}

/// Returns whether values[k] begins a cluster.
bool is_gap(const Eigen::VectorXd& values, Eigen::Index k, double shift) {
  if (k == 0) return true;
  return !is_rigid(values[k], shift) && values[k] - values[k - 1] >= kCluster * values[k];
}

/// The cluster that contains values[k]: its first index and, if it ends among the values, one past
/// its last.
struct Cluster {
  Eigen::Index begin;
  Eigen::Index end;
};

Cluster cluster_of(const Eigen::VectorXd& values, Eigen::Index k, double shift) {
  Cluster cluster{k, k + 1};
  while (!is_gap(values, cluster.begin, shift)) --cluster.begin;
  while (cluster.end < values.size() && !is_gap(values, cluster.end, shift)) ++cluster.end;
  return cluster;
}

/// Text of a cluster: "the 6 rigid-body motions", "the 2 modes at 98.5 Hz".
std::string name_of(const Cluster& cluster, const Eigen::VectorXd& values, double shift) {
  const std::string count = "the " + std::to_string(cluster.end - cluster.begin);
  const double first = values[cluster.begin];
  return count + (shift != 0 && is_rigid(first, shift) ? " rigid-body motions"
                                                       : " modes at " + hertz(first));
}

double between(const Eigen::VectorXd& values, Eigen::Index k) {
  return (std::max(values[k - 1], 0.0) + values[k]) / 2;
}

std::string complete_below(double eigenvalue) {
  return "checked: no mode is missing below " + hertz(eigenvalue) + ", by inertia";
}

/// Sentence on the completeness of `count` modes among values without gaps.
std::string completeness_of(const Eigen::VectorXd& values, Eigen::Index count, double shift) {
  const Cluster last = cluster_of(values, count - 1, shift);
  if (last.end == count) {
    return count == values.size() ? "checked: all modes of the structure were found"
                                  : complete_below(between(values, count));
  }
  const std::string cut = "; the number of modes splits " + name_of(last, values, shift);
  return (last.begin == 0 ? kNotChecked : complete_below(between(values, last.begin))) + cut;
}

/// Eigenpairs with the rigid motions, whose eigenvalues are zero, before the other modes.
EigenPairs with_rigid(const Eigen::MatrixXd& rigid, const EigenPairs& elastic) {
  if (rigid.cols() == 0) return elastic;
  EigenPairs all{Eigen::VectorXd::Zero(rigid.cols() + elastic.values.size()),
                 Eigen::MatrixXd(rigid.rows(), rigid.cols() + elastic.values.size()), elastic.next,
                 elastic.search};
  all.values.tail(elastic.values.size()) = elastic.values;
  all.vectors.leftCols(rigid.cols()) = rigid;
  all.vectors.rightCols(elastic.values.size()) = elastic.vectors;
  return all;
}

}  // namespace

std::optional<std::string> check_complete(const ModalSystem& system, const EigenPairs& pairs,
                                          Eigen::Index count, double shift) {
  const Eigen::VectorXd& values = pairs.values;
  const Eigen::Index end = cluster_of(values, count - 1, shift).end;
  if (end == values.size()) return std::nullopt;
  const double sigma = between(values, end);
  const MatHandle shifted = shifted_stiffness(system.stiffness(), system.mass(), sigma);
  const Eigen::Index counted = negative_eigenvalues(shifted.get(), system.ranks());
  if (counted != end) {
    throw ComputationError("the eigensolver found " + std::to_string(end) + " modes below " +
                           hertz(sigma) + ", but the Sturm sequence check counts " +
                           std::to_string(counted));
  }
  return completeness_of(values, count, shift);
}

void check_eigenvalues(const Eigen::VectorXd& values, double shift) {
  const double scale = std::max(std::abs(shift), values.cwiseAbs().maxCoeff());
  for (Eigen::Index k = 0; k < values.size(); ++k) {
    if (values[k] >= -kRigidBody * scale && std::isfinite(values[k])) continue;
    throw ComputationError("eigenvalue " + std::to_string(k + 1) + " is " +
                           rounded_text(values[k], 3) +
                           " 1/s^2, expected a number >= 0: the stiffness or mass matrix is not "
                           "positive definite, or too close to singular");
  }
}

void warn_of_cut(const EigenPairs& pairs, double shift, const Progress& warn) {
  const Eigen::Index count = pairs.values.size();
  if (count == 0 || !warn || (shift != 0 && is_rigid(pairs.next, shift))) return;
  const std::string cuts = "the number of modes, " + std::to_string(count) + ", splits ";
  if (!(pairs.next - pairs.values[count - 1] < kCluster * pairs.next)) return;
  const Eigen::Index begin = cluster_of(pairs.values, count - 1, shift).begin;
  warn(cuts + "a cluster of equal frequencies at " + hertz(pairs.values[begin]) +
       ", of which any combination is a mode; request more modes" +
       (begin > 0 ? ", or only " + std::to_string(begin) : ""));
}

CheckedModes lowest_modes(const ModalSystem& system, const LinearSolver& inverse,
                          Eigen::Index count, const Eigen::MatrixXd& rigid, bool check,
                          const Progress& warn) {
  const Eigen::Index size = size_of(system.mass());
  for (Eigen::Index more = check ? 1 : 0;; more = 2 * more) {
    const Eigen::Index asked = std::min<Eigen::Index>(count + more, size);
    EigenPairs pairs = with_rigid(
        rigid, lowest_eigenpairs(system.mass(), inverse,
                                 std::max<Eigen::Index>(asked - rigid.cols(), 1), rigid));
    std::string completeness = kNotChecked;
    if (check) {
      auto checked = check_complete(system, pairs, count, inverse.shift());
      if (!checked && asked == size)
        checked = completeness_of(pairs.values, count, inverse.shift());
      if (!checked) continue;
      completeness = *checked;
    }
    EigenPairs lowest{pairs.values.head(count), pairs.vectors.leftCols(count), pairs.next,
                      pairs.search};
    if (pairs.values.size() > count) lowest.next = pairs.values[count];
    warn_of_cut(lowest, inverse.shift(), warn);
    return {std::move(lowest), completeness};
  }
}

}  // namespace flexneck::fe_modal
