// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/solve/refined/refined_modes.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "fe_modal/solve/refined/refined_basis.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/symmetric_pairs.h"

namespace flexneck::fe_modal {
namespace {

constexpr int kMaxSteps = 60;
/// Of the change from mesh to mesh, what the steps left out included: what that may come to.
constexpr double kShare = 1.0 / 3;
/// The same of a mode that is above that of the mesh before, whose change shrinks as it settles.
constexpr double kShareAbove = 0.05;
constexpr double kRounding = 1e-7;
/// And of the eigenvalue at most: where steps start from far above, most of the change is theirs.
constexpr double kLargest = 0.05;
/// Of the excess a step leaves from three to seven tenths, more from step to step. Gains go up and
/// down, and the first ones fall faster: the series is taken with the ratio over two steps, of a
/// mode or of all, whichever falls slower, and a twentieth slower than that, but not below the
/// first of these. These and the shares above are calibrated on the meshes of
/// certificate_benchmark.
constexpr double kFastest = 0.6;
constexpr double kSlowest = 0.9;
constexpr double kSlowing = 1.05;
/// Directions of a basis of unit columns that are shorter have nothing new.
constexpr double kNothingNew = 1e-12;

/// The lowest pairs of the projection on the columns, as combinations of them; fewer where the
/// columns depend on one another.
EigenPairs ritz_pairs(const RefinedBasis& basis, Eigen::Index count) {
  const auto mass = basis.mass();
  const Eigen::VectorXd scale = mass.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const SymmetricPairs lengths = symmetric_pairs(scale.asDiagonal() * mass * scale.asDiagonal());
  const Eigen::Index kept = (lengths.values.array() > kNothingNew).count();
  const Eigen::MatrixXd independent =
      scale.asDiagonal() * lengths.vectors.rightCols(kept) *
      lengths.values.tail(kept).cwiseSqrt().cwiseInverse().asDiagonal();
  const SymmetricPairs ritz =
      symmetric_pairs(independent.transpose() * basis.stiffness() * independent);
  count = std::min(count, kept);
  return {ritz.values.head(count), independent * ritz.vectors.leftCols(count)};
}

/// How the eigenvalues settle: what steps gain is continued as a geometric series.
class Settling {
 public:
  Settling(const Eigen::VectorXd& coarse, Eigen::Index rigid_count)
      : coarse_(coarse), rigid_count_(std::min(rigid_count, coarse.size())) {
    gains_.reserve(kMaxSteps);
  }

  void take(const Eigen::VectorXd& values) {
    if (values_.size() > 0) gains_.push_back((values_ - values).cwiseMax(0));
    values_ = values;
  }
  /// How far the values may be above the eigenvalues.
  /// @pre some steps have been taken
  Eigen::VectorXd excess() const {
    const Eigen::ArrayXd last = gains_.back();
    const Eigen::ArrayXd before = gains_[gains_.size() - 2];
    const Eigen::ArrayXd earlier = gains_[gains_.size() - 3];
    const double of_all = ratio_of(relative_sum(last), relative_sum(earlier));
    const Eigen::ArrayXd ratio =
        (kSlowing * last.binaryExpr(earlier, &ratio_of).max(of_all)).max(kFastest).min(kSlowest);
    Eigen::VectorXd excess = last.max(ratio * before) * ratio / (1 - ratio);
    excess.head(rigid_count_).setZero();
    return excess;
  }
  bool has_ended() const {
    if (gains_.size() < 3) return false;
    const Eigen::ArrayXd above = excess();
    const Eigen::ArrayXd change =
        (values_ - coarse_).array().abs().max((values_.array() - above - coarse_.array()).abs());
    const Eigen::ArrayXd share = (values_.array() > coarse_.array())
                                     .select(Eigen::ArrayXd::Constant(change.size(), kShareAbove),
                                             Eigen::ArrayXd::Constant(change.size(), kShare));
    const Eigen::ArrayXd allowed =
        (share * change).min(kLargest * coarse_.array().abs()).max(kRounding * values_.array());
    return (above <= allowed).tail(values_.size() - rigid_count_).all();
  }

 private:
  /// What a step leaves, by its gain and that of the step two before.
  static double ratio_of(double last, double earlier) {
    return earlier > 0 ? std::sqrt(last / earlier) : 0;
  }
  /// Of the elastic modes, each against its eigenvalue.
  double relative_sum(const Eigen::ArrayXd& gains) const {
    const Eigen::Index elastic = values_.size() - rigid_count_;
    return (gains.tail(elastic) / values_.array().tail(elastic)).sum();
  }

  const Eigen::VectorXd& coarse_;
  Eigen::Index rigid_count_;
  Eigen::VectorXd values_;
  std::vector<Eigen::VectorXd> gains_;
};

/// K x - lambda M x of the elastic modes.
Eigen::MatrixXd residuals_of(const RefinedBasis::Modes& modes, const Eigen::VectorXd& values,
                             Eigen::Index elastic) {
  return modes.forces.rightCols(elastic) -
         modes.momenta.rightCols(elastic).cast<double>() * values.tail(elastic).asDiagonal();
}

/// Where the elastic modes are to go.
Eigen::MatrixXd find_directions(const RefinedSystem& system, const RefinedBasis::Modes& modes,
                                const Eigen::VectorXd& values, Eigen::Index elastic) {
  // Allocated before the temporaries, which else would leave gaps in the heap.
  Eigen::MatrixXd directions(modes.vectors.rows(), elastic);
  Eigen::MatrixXd residuals = residuals_of(modes, values, elastic);
  system.precondition(residuals, directions);
  if (!system.has_cells()) return directions;
  residuals -= system.forces(directions);
  system.add_cells(1, residuals, directions);
  return directions;
}

/// The modes of the mesh before, with what is within its elements as it must be. Where nothing is
/// left of some, which were within an element, all are taken as they were.
RefinedBasis first_basis(const RefinedSystem& system, const EigenPairs& coarse,
                         Eigen::Index directions) {
  const Eigen::Index count = coarse.values.size();
  const auto basis_of = [&](Eigen::MatrixXd vectors) {
    RefinedBasis basis(system.ranks(), vectors.rows(), count, directions);
    ElementOperator::Products products = system.products(vectors);
    basis.append(std::move(vectors), std::move(products));
    return basis;
  };
  Eigen::MatrixXd vectors = system.prolonged(coarse.vectors);
  if (!system.has_cells()) return basis_of(std::move(vectors));
  system.add_cells(-1, system.forces(vectors), vectors);
  RefinedBasis basis = basis_of(std::move(vectors));
  if (ritz_pairs(basis, count).values.size() == count) return basis;
  return basis_of(system.prolonged(coarse.vectors));
}

}  // namespace

RefinedModes refined_modes(const RefinedSystem& system, const EigenPairs& coarse,
                           Eigen::Index rigid_count) {
  const Eigen::Index count = coarse.values.size();
  rigid_count = std::min(rigid_count, count);
  RefinedBasis basis = first_basis(system, coarse, count - rigid_count);
  Settling settling(coarse.values, rigid_count);
  for (int step = 0; step <= kMaxSteps; ++step) {
    const EigenPairs ritz = ritz_pairs(basis, count);
    settling.take(ritz.values);
    if (settling.has_ended() || rigid_count == count) {
      return {ritz.values, rigid_count == count ? Eigen::VectorXd::Zero(count) : settling.excess(),
              basis.combined(ritz.vectors)};
    }
    // Of rigid motions there is nothing but rounding in the other columns.
    const Eigen::Index others = ritz.vectors.rows() - count;
    basis.combine(ritz.vectors.topRows(count),
                  ritz.vectors.bottomRows(others).rightCols(others > 0 ? count - rigid_count : 0));
    Eigen::MatrixXd directions =
        find_directions(system, basis.modes(), ritz.values, count - rigid_count);
    ElementOperator::Products products = system.products(directions);
    basis.append(std::move(directions), std::move(products));
  }
  throw ComputationError(
      "the modes of the mesh cut in eight, by which its error is estimated, do "
      "not settle in " +
      std::to_string(kMaxSteps) +
      " iterations: 27-node hexahedra do better where Poisson's ratio is near "
      "1/2; or leave out modes.certify");
}

}  // namespace flexneck::fe_modal
