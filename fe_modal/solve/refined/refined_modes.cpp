// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/solve/refined/refined_modes.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "fe_modal/algebra/matrix_product.h"
#include "fe_modal/algebra/row_panels.h"
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

/// Columns with their forces and momenta. These are kept in single precision: in residuals they are
/// no larger than what is sought, where terms of the forces cancel by six digits.
struct Block {
  Eigen::MatrixXd vectors;
  Eigen::MatrixXd forces;
  Eigen::MatrixXf momenta;
};

/// What the modes are sought in: the modes so far, the directions that they went, and new ones;
/// with K and M projected on them.
class Basis {
 public:
  /// @param capacity columns at most. The projections are allocated once: small blocks that come
  /// and go between the vectors would fragment the heap.
  Basis(const Ranks& ranks, Eigen::Index capacity)
      : ranks_(ranks), stiffness_(capacity, capacity), mass_(capacity, capacity) {
    blocks_.reserve(3);
  }

  void append(Eigen::MatrixXd vectors, ElementOperator::Products products) {
    count_ += vectors.cols();
    blocks_.push_back(
        {std::move(vectors), std::move(products.forces), products.momenta.cast<float>()});
    project_last(blocks_.back().forces, stiffness_);
    project_last(products.momenta, mass_);
  }
  const Block& modes() const { return blocks_.front(); }
  /// Combinations of the vectors of all columns; of the basis nothing is left.
  Eigen::MatrixXd combined(const Eigen::MatrixXd& combinations) && {
    for (Block& block : blocks_) {
      block.forces.resize(0, 0);
      block.momenta.resize(0, 0);
    }
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(modes().vectors.rows(), combinations.cols());
    Eigen::Index first = 0;
    for (const Block& block : blocks_) {
      const Eigen::Index count = block.vectors.cols();
      multiply(1, block.vectors, combinations.middleRows(first, count), 1, result);
      first += count;
    }
    return result;
  }
  auto stiffness() const { return stiffness_.topLeftCorner(count_, count_); }
  auto mass() const { return mass_.topLeftCorner(count_, count_); }

  /// The modes become combinations of all columns. What the last of them take from the other blocks
  /// becomes the only other block: the directions that they went.
  /// @param of_modes (modes, modes)
  /// @param of_others (other columns, as many as the second block has), or nothing
  void combine(const Eigen::MatrixXd& of_modes, const Eigen::MatrixXd& of_others) {
    const Combination combination{of_modes, of_others};
    for_each_panel(modes().vectors.rows(), [&](Eigen::Index first, Eigen::Index rows) {
      combine_rows(&Block::vectors, first, rows, combination);
      combine_rows(&Block::forces, first, rows, combination);
      combine_rows(&Block::momenta, first, rows, combination);
    });
    blocks_.resize(of_others.cols() > 0 ? 2 : 1);
    const Eigen::MatrixXd all = combination.of(Eigen::MatrixXd::Identity(count_, count_));
    const Eigen::MatrixXd stiffness_after = all.transpose() * stiffness() * all;
    const Eigen::MatrixXd mass_after = all.transpose() * mass() * all;
    count_ = all.cols();
    stiffness_.topLeftCorner(count_, count_) = stiffness_after;
    mass_.topLeftCorner(count_, count_) = mass_after;
  }

 private:
  /// As combine() has them.
  struct Combination {
    const Eigen::MatrixXd& of_modes;
    const Eigen::MatrixXd& of_others;

    /// @param all rows of all columns
    /// @return those of the modes and of the directions that they went
    Eigen::MatrixXd of(const Eigen::MatrixXd& all) const {
      const Eigen::Index count = of_modes.cols();
      const Eigen::Index moved = of_others.cols();
      Eigen::MatrixXd after(all.rows(), count + moved);
      multiply(1, all.leftCols(count), of_modes, 0, after.leftCols(count));
      if (moved > 0) {
        multiply(1, all.rightCols(of_others.rows()), of_others, 0, after.rightCols(moved));
        after.middleCols(count - moved, moved) += after.rightCols(moved);
      }
      return after;
    }
  };

  template <typename Columns>
  void combine_rows(Columns Block::*field, Eigen::Index first, Eigen::Index rows,
                    const Combination& combination) {
    using Scalar = typename Columns::Scalar;
    Eigen::MatrixXd all(rows, count_);
    Eigen::Index column = 0;
    for (const Block& block : blocks_) {
      const auto own = (block.*field).middleRows(first, rows);
      all.middleCols(column, own.cols()) = own.template cast<double>();
      column += own.cols();
    }
    const Eigen::MatrixXd after = combination.of(all);
    const Eigen::Index moved = combination.of_others.cols();
    (blocks_[0].*field).middleRows(first, rows) =
        after.leftCols(after.cols() - moved).template cast<Scalar>();
    if (moved == 0) return;
    (blocks_[1].*field).middleRows(first, rows) = after.rightCols(moved).template cast<Scalar>();
  }

  /// Adds the columns and rows of the last block.
  /// @param products of K or M with it
  void project_last(const Eigen::MatrixXd& products, Eigen::MatrixXd& projected) const {
    const Eigen::Index more = products.cols();
    const Eigen::Index before = count_ - more;
    Eigen::MatrixXd added = Eigen::MatrixXd::Zero(count_, more);
    for_each_panel(products.rows(), [&](Eigen::Index first, Eigen::Index rows) {
      Eigen::Index row = 0;
      for (const Block& block : blocks_) {
        const Eigen::Index count = block.vectors.cols();
        multiply_transpose(1, block.vectors.middleRows(first, rows),
                           products.middleRows(first, rows), 1, added.middleRows(row, count));
        row += count;
      }
    });
    ranks_.sum(added);
    projected.block(0, before, count_, more) = added;
    projected.block(before, 0, more, before) = added.topRows(before).transpose();
  }

  Ranks ranks_;
  Eigen::Index count_ = 0;  ///< of the columns of all blocks
  Eigen::MatrixXd stiffness_;
  Eigen::MatrixXd mass_;
  std::vector<Block> blocks_;
};

/// The lowest pairs of the projection on the columns, as combinations of them; fewer where the
/// columns depend on one another.
EigenPairs ritz_pairs(const Basis& basis, Eigen::Index count) {
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
Eigen::MatrixXd residuals_of(const Block& modes, const Eigen::VectorXd& values,
                             Eigen::Index elastic) {
  return modes.forces.rightCols(elastic) -
         modes.momenta.rightCols(elastic).cast<double>() * values.tail(elastic).asDiagonal();
}

/// Where the elastic modes are to go.
Eigen::MatrixXd find_directions(const RefinedSystem& system, const Block& modes,
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
Basis first_basis(const RefinedSystem& system, const EigenPairs& coarse, Eigen::Index capacity) {
  const auto basis_of = [&](Eigen::MatrixXd vectors) {
    Basis basis(system.ranks(), capacity);
    ElementOperator::Products products = system.products(vectors);
    basis.append(std::move(vectors), std::move(products));
    return basis;
  };
  Eigen::MatrixXd vectors = system.prolonged(coarse.vectors);
  if (!system.has_cells()) return basis_of(std::move(vectors));
  system.add_cells(-1, system.forces(vectors), vectors);
  Basis basis = basis_of(std::move(vectors));
  const Eigen::Index count = coarse.values.size();
  if (ritz_pairs(basis, count).values.size() == count) return basis;
  return basis_of(system.prolonged(coarse.vectors));
}

}  // namespace

RefinedModes refined_modes(const RefinedSystem& system, const EigenPairs& coarse,
                           Eigen::Index rigid_count) {
  const Eigen::Index count = coarse.values.size();
  rigid_count = std::min(rigid_count, count);
  Basis basis = first_basis(system, coarse, 3 * count - 2 * rigid_count);
  Settling settling(coarse.values, rigid_count);
  for (int step = 0; step <= kMaxSteps; ++step) {
    const EigenPairs ritz = ritz_pairs(basis, count);
    settling.take(ritz.values);
    if (settling.has_ended() || rigid_count == count) {
      return {ritz.values, rigid_count == count ? Eigen::VectorXd::Zero(count) : settling.excess(),
              std::move(basis).combined(ritz.vectors)};
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
