// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/solve/refined/refined_modes.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Eigenvalues>

#include "fe_modal/algebra/matrix_product.h"
#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {
namespace {

constexpr int kMaxSteps = 60;
/// Of the change from mesh to mesh, or of the eigenvalue: what the steps left out may come to.
constexpr double kShare = 0.25;
/// The same of a mode that is above that of the mesh before, whose change shrinks as it settles.
constexpr double kShareAbove = 0.05;
constexpr double kRounding = 1e-7;
/// And of the eigenvalue at most: where steps start from far above, most of the change is theirs.
constexpr double kLargest = 0.05;
/// The ratio of two steps' gains rises from step to step: the series is taken with so much more.
constexpr double kSlowing = 1.3;
constexpr double kSlowest = 0.95;
/// Directions of a basis of unit columns that are shorter have nothing new.
constexpr double kNothingNew = 1e-12;

/// Columns with their forces and momenta, of which the first are in use.
class Columns {
 public:
  Columns(Eigen::Index rows, Eigen::Index capacity)
      : vectors_(rows, capacity), forces_(rows, capacity), momenta_(rows, capacity) {}

  Eigen::Index count() const { return count_; }
  void clear() { count_ = 0; }
  auto vectors() const { return vectors_.leftCols(count_); }
  auto forces() const { return forces_.leftCols(count_); }
  auto momenta() const { return momenta_.leftCols(count_); }

  void append(Eigen::MatrixXd vectors, ElementOperator::Products products) {
    const Eigen::Index more = vectors.cols();
    const auto move = [&](Eigen::MatrixXd& from, Eigen::MatrixXd& to) {
      to.middleCols(count_, more) = from;
      from.resize(0, 0);  // frees it before the next is written
    };
    move(vectors, vectors_);
    move(products.forces, forces_);
    move(products.momenta, momenta_);
    count_ += more;
  }
  /// Replaces the columns by combinations of them.
  void combine(const Eigen::MatrixXd& combination) {
    for (Eigen::MatrixXd* const columns : {&vectors_, &forces_, &momenta_}) {
      constexpr Eigen::Index kRows = 4096;
      Eigen::MatrixXd turned;
      for (Eigen::Index first = 0; first < columns->rows(); first += kRows) {
        auto rows = columns->middleRows(first, std::min(kRows, columns->rows() - first));
        turned.resize(rows.rows(), combination.cols());
        multiply(1, rows.leftCols(count_), combination, 0, turned);
        rows.leftCols(combination.cols()) = turned;
      }
    }
    count_ = combination.cols();
  }

 private:
  Eigen::MatrixXd vectors_;
  Eigen::MatrixXd forces_;
  Eigen::MatrixXd momenta_;
  Eigen::Index count_ = 0;
};

/// The lowest pairs of the projection on the columns, as combinations of them; fewer where the
/// columns depend on one another.
EigenPairs ritz_pairs(const Ranks& ranks, const Columns& columns, Eigen::Index count) {
  const Eigen::MatrixXd stiffness = inner_products(ranks, columns.vectors(), columns.forces());
  const Eigen::MatrixXd mass = inner_products(ranks, columns.vectors(), columns.momenta());
  const Eigen::VectorXd scale = mass.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> lengths(scale.asDiagonal() * mass *
                                                               scale.asDiagonal());
  const Eigen::Index kept = (lengths.eigenvalues().array() > kNothingNew).count();
  const Eigen::MatrixXd basis =
      scale.asDiagonal() * lengths.eigenvectors().rightCols(kept) *
      lengths.eigenvalues().tail(kept).cwiseSqrt().cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ritz(basis.transpose() * stiffness * basis);
  count = std::min(count, kept);
  return {ritz.eigenvalues().head(count), basis * ritz.eigenvectors().leftCols(count)};
}

/// How the eigenvalues settle: what steps gain is continued as a geometric series, by the slower of
/// the last two ratios.
class Settling {
 public:
  Settling(const Eigen::VectorXd& coarse, Eigen::Index rigid_count)
      : coarse_(coarse), rigid_count_(std::min(rigid_count, coarse.size())) {}

  void take(const Eigen::VectorXd& values) {
    if (values_.size() > 0) gains_.push_back((values_ - values).cwiseMax(0));
    values_ = values;
  }
  /// How far the values may be above the eigenvalues.
  /// @pre some steps have been taken
  Eigen::VectorXd excess() const {
    const Eigen::ArrayXd last = gains_.back();
    const Eigen::ArrayXd before = gains_[gains_.size() - 2];
    const Eigen::ArrayXd first = gains_[gains_.size() - 3];
    const auto ratio_of = [](double later, double earlier) {
      return earlier > 0 ? std::min(kSlowing * later / earlier, kSlowest) : kSlowest;
    };
    const Eigen::ArrayXd ratio =
        last.binaryExpr(before, ratio_of).max(before.binaryExpr(first, ratio_of));
    Eigen::VectorXd excess = last * ratio / (1 - ratio);
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
  const Eigen::VectorXd& coarse_;
  Eigen::Index rigid_count_;
  Eigen::VectorXd values_;
  std::vector<Eigen::VectorXd> gains_;
};

/// K x - lambda M x of the last of the columns' first ones.
Eigen::MatrixXd residuals_of(const Columns& columns, const Eigen::VectorXd& values,
                             Eigen::Index rigid_count) {
  const Eigen::Index elastic = values.size() - rigid_count;
  return columns.forces().middleCols(rigid_count, elastic) -
         columns.momenta().middleCols(rigid_count, elastic) * values.tail(elastic).asDiagonal();
}

/// Where vectors with these residuals are to go.
Eigen::MatrixXd directions_against(const RefinedSystem& system, Eigen::MatrixXd residuals) {
  Eigen::MatrixXd directions = system.precondition(residuals);
  residuals -= system.forces(directions);
  directions += system.solve_cells(residuals);
  return directions;
}

/// Ritz vectors, and behind them of the elastic ones what they have of other columns than the Ritz
/// vectors before: the directions that they went.
Eigen::MatrixXd with_directions(const Eigen::MatrixXd& best, Eigen::Index rigid_count) {
  const Eigen::Index elastic = best.cols() - rigid_count;
  Eigen::MatrixXd combination(best.rows(), best.cols() + elastic);
  combination << best, best.rightCols(elastic);
  combination.topRightCorner(best.cols(), elastic).setZero();
  return combination;
}

/// The modes of the mesh before, with what is within its elements as it must be. Where nothing is
/// left of some, which were within an element, all are taken as they were.
void start(const RefinedSystem& system, const EigenPairs& coarse, Columns& columns) {
  Eigen::MatrixXd vectors = system.prolonged(coarse.vectors);
  vectors -= system.solve_cells(system.forces(vectors));
  ElementOperator::Products products = system.products(vectors);
  columns.append(std::move(vectors), std::move(products));
  const Eigen::Index count = coarse.values.size();
  if (ritz_pairs(system.ranks(), columns, count).values.size() == count) return;
  columns.clear();
  vectors = system.prolonged(coarse.vectors);
  products = system.products(vectors);
  columns.append(std::move(vectors), std::move(products));
}

}  // namespace

RefinedModes refined_modes(const RefinedSystem& system, const EigenPairs& coarse,
                           Eigen::Index rigid_count) {
  const Ranks& ranks = system.ranks();
  const Eigen::Index count = coarse.values.size();
  rigid_count = std::min(rigid_count, count);
  Columns columns(system.fields().own_dof_count(), 3 * count);
  start(system, coarse, columns);
  Settling settling(coarse.values, rigid_count);
  for (int step = 0; step <= kMaxSteps; ++step) {
    const EigenPairs ritz = ritz_pairs(ranks, columns, count);
    settling.take(ritz.values);
    if (settling.has_ended() || rigid_count == count) {
      columns.combine(ritz.vectors);
      return {ritz.values, rigid_count == count ? Eigen::VectorXd::Zero(count) : settling.excess(),
              columns.vectors()};
    }
    columns.combine(step == 0 ? ritz.vectors : with_directions(ritz.vectors, rigid_count));
    Eigen::MatrixXd directions =
        directions_against(system, residuals_of(columns, ritz.values, rigid_count));
    ElementOperator::Products products = system.products(directions);
    columns.append(std::move(directions), std::move(products));
  }
  throw ComputationError(
      "the modes of the mesh cut in eight, by which its error is estimated, do "
      "not settle in " +
      std::to_string(kMaxSteps) +
      " iterations: 27-node hexahedra do better where Poisson's ratio is near "
      "1/2; or leave out modes.certify");
}

}  // namespace flexneck::fe_modal
