// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/solve/refined/refined_modes.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "fe_modal/algebra/matrix_product.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/symmetric_pairs.h"

namespace flexneck::fe_modal {
namespace {

constexpr int kMaxSteps = 60;
/// Of the change from mesh to mesh, what the steps left out included: what that may come to.
constexpr double kShare = 0.28;
/// The same of a mode that is above that of the mesh before, whose change shrinks as it settles.
constexpr double kShareAbove = 0.05;
constexpr double kRounding = 1e-7;
/// And of the eigenvalue at most: where steps start from far above, most of the change is theirs.
constexpr double kLargest = 0.05;
/// Of the excess a step leaves from three to seven tenths, more from step to step. Gains go up and
/// down, and the first ones fall faster: the series is taken with the ratio over two steps, of a
/// mode or of all, whichever falls slower, and a tenth slower than that, but not below the first of
/// these. Calibrated on the meshes of certificate_benchmark, as is kShare.
constexpr double kFastest = 0.6;
constexpr double kSlowest = 0.9;
constexpr double kSlowing = 1.1;
/// Directions of a basis of unit columns that are shorter have nothing new.
constexpr double kNothingNew = 1e-12;

/// Columns with their forces and momenta.
struct Block {
  Eigen::MatrixXd vectors;
  Eigen::MatrixXd forces;
  Eigen::MatrixXd momenta;
};

/// What the modes are sought in: the modes so far, the directions that they went, and new ones;
/// with K and M projected on them.
class Basis {
 public:
  explicit Basis(const Ranks& ranks) : ranks_(ranks) {}

  void append(Eigen::MatrixXd vectors, ElementOperator::Products products) {
    blocks_.push_back(
        {std::move(vectors), std::move(products.forces), std::move(products.momenta)});
    project_last(&Block::forces, stiffness_);
    project_last(&Block::momenta, mass_);
  }
  const Block& modes() const { return blocks_.front(); }
  /// Combinations of the vectors of all columns.
  Eigen::MatrixXd vectors_of(const Eigen::MatrixXd& combinations) const {
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(modes().vectors.rows(), combinations.cols());
    Eigen::Index first = 0;
    for (const Block& block : blocks_) {
      const Eigen::Index count = block.vectors.cols();
      multiply(1, block.vectors, combinations.middleRows(first, count), 1, result);
      first += count;
    }
    return result;
  }
  const Eigen::MatrixXd& stiffness() const { return stiffness_; }
  const Eigen::MatrixXd& mass() const { return mass_; }

  /// Combinations of all columns become the modes and, if there are any, the directions; no other
  /// block is left.
  /// @pre no more than the columns of the first and the second block
  void combine(const Eigen::MatrixXd& modes, const Eigen::MatrixXd& directions) {
    constexpr Eigen::Index kRows = 1024;
    std::vector<const Eigen::MatrixXd*> combinations = {&modes};
    if (directions.cols() > 0) combinations.push_back(&directions);
    Eigen::MatrixXd before;
    Eigen::MatrixXd after;
    for (Eigen::MatrixXd Block::*const field : {&Block::vectors, &Block::forces, &Block::momenta}) {
      const Eigen::Index size = (blocks_.front().*field).rows();
      for (Eigen::Index first = 0; first < size; first += kRows) {
        const Eigen::Index rows = std::min(kRows, size - first);
        before.resize(rows, modes.rows());
        Eigen::Index column = 0;
        for (const Block& block : blocks_) {
          const auto own = (block.*field).middleRows(first, rows);
          before.middleCols(column, own.cols()) = own;
          column += own.cols();
        }
        for (std::size_t k = 0; k < combinations.size(); ++k) {
          after.resize(rows, combinations[k]->cols());
          multiply(1, before, *combinations[k], 0, after);
          (blocks_[k].*field).block(first, 0, rows, after.cols()) = after;
        }
      }
      for (std::size_t k = 0; k < blocks_.size(); ++k) {
        const Eigen::Index kept = k < combinations.size() ? combinations[k]->cols() : 0;
        if ((blocks_[k].*field).cols() > kept) {
          (blocks_[k].*field).conservativeResize(Eigen::NoChange, kept);
        }
      }
    }
    blocks_.resize(combinations.size());
    Eigen::MatrixXd all(modes.rows(), modes.cols() + directions.cols());
    all.leftCols(modes.cols()) = modes;
    if (directions.cols() > 0) all.rightCols(directions.cols()) = directions;
    stiffness_ = all.transpose() * stiffness_ * all;
    mass_ = all.transpose() * mass_ * all;
  }

 private:
  /// Adds the columns and rows of the last block.
  void project_last(Eigen::MatrixXd Block::*field, Eigen::MatrixXd& projected) const {
    const Eigen::Index more = blocks_.back().vectors.cols();
    const Eigen::Index count = projected.rows() + more;
    projected.conservativeResize(count, count);
    Eigen::Index row = 0;
    for (const Block& block : blocks_) {
      const Eigen::Index rows = block.vectors.cols();
      const Eigen::MatrixXd part = inner_products(ranks_, block.vectors, blocks_.back().*field);
      projected.block(row, count - more, rows, more) = part;
      projected.block(count - more, row, more, rows) = part.transpose();
      row += rows;
    }
  }

  Ranks ranks_;
  Eigen::MatrixXd stiffness_;
  Eigen::MatrixXd mass_;
  std::vector<Block> blocks_;
};

/// The lowest pairs of the projection on the columns, as combinations of them; fewer where the
/// columns depend on one another.
EigenPairs ritz_pairs(const Basis& basis, Eigen::Index count) {
  const Eigen::MatrixXd& mass = basis.mass();
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
Eigen::MatrixXd residuals_of(const Block& modes, const Eigen::VectorXd& values,
                             Eigen::Index rigid_count) {
  const Eigen::Index elastic = values.size() - rigid_count;
  return modes.forces.rightCols(elastic) -
         modes.momenta.rightCols(elastic) * values.tail(elastic).asDiagonal();
}

/// Where vectors with these residuals are to go.
Eigen::MatrixXd directions_against(const RefinedSystem& system, Eigen::MatrixXd residuals) {
  Eigen::MatrixXd directions = system.precondition(residuals);
  residuals -= system.forces(directions);
  directions += system.solve_cells(residuals);
  return directions;
}

/// What elastic Ritz vectors have of other columns than the Ritz vectors before: the directions
/// that they went. None where there are no other columns.
Eigen::MatrixXd directions_of(const Eigen::MatrixXd& best, Eigen::Index rigid_count) {
  if (best.rows() == best.cols()) return {};
  Eigen::MatrixXd directions = best.rightCols(best.cols() - rigid_count);
  directions.topRows(best.cols()).setZero();
  return directions;
}

/// The modes of the mesh before, with what is within its elements as it must be. Where nothing is
/// left of some, which were within an element, all are taken as they were.
void start(const RefinedSystem& system, const EigenPairs& coarse, Basis& basis) {
  const auto append = [&](Eigen::MatrixXd vectors) {
    ElementOperator::Products products = system.products(vectors);
    basis.append(std::move(vectors), std::move(products));
  };
  Eigen::MatrixXd vectors = system.prolonged(coarse.vectors);
  vectors -= system.solve_cells(system.forces(vectors));
  append(std::move(vectors));
  const Eigen::Index count = coarse.values.size();
  if (ritz_pairs(basis, count).values.size() == count) return;
  basis = Basis(system.ranks());
  append(system.prolonged(coarse.vectors));
}

}  // namespace

RefinedModes refined_modes(const RefinedSystem& system, const EigenPairs& coarse,
                           Eigen::Index rigid_count) {
  const Eigen::Index count = coarse.values.size();
  rigid_count = std::min(rigid_count, count);
  Basis basis(system.ranks());
  start(system, coarse, basis);
  Settling settling(coarse.values, rigid_count);
  for (int step = 0; step <= kMaxSteps; ++step) {
    const EigenPairs ritz = ritz_pairs(basis, count);
    settling.take(ritz.values);
    if (settling.has_ended() || rigid_count == count) {
      return {ritz.values, rigid_count == count ? Eigen::VectorXd::Zero(count) : settling.excess(),
              basis.vectors_of(ritz.vectors)};
    }
    basis.combine(ritz.vectors, directions_of(ritz.vectors, rigid_count));
    Eigen::MatrixXd directions =
        directions_against(system, residuals_of(basis.modes(), ritz.values, rigid_count));
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
