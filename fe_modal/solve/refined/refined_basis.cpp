// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/solve/refined/refined_basis.h"

#include <type_traits>
#include <utility>

#include "fe_modal/algebra/matrix_product.h"
#include "fe_modal/algebra/row_panels.h"

namespace flexneck::fe_modal {
namespace {

constexpr auto kVectors = [](auto& block) -> auto& { return block.vectors; };
constexpr auto kForces = [](auto& block) -> auto& { return block.forces; };
constexpr auto kMomenta = [](auto& block) -> auto& { return block.momenta; };

}  // namespace

/// As combine() has them.
struct RefinedBasis::Combination {
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

/// Rows of a field of all columns.
template <typename Field>
Eigen::MatrixXd RefinedBasis::rows_of(const Field& field, Eigen::Index first,
                                      Eigen::Index rows) const {
  Eigen::MatrixXd all(rows, count_);
  Eigen::Index column = 0;
  const auto take = [&](const auto& block, Eigen::Index count) {
    all.middleCols(column, count) =
        field(block).block(first, 0, rows, count).template cast<double>();
    column += count;
  };
  take(modes_, modes_.vectors.cols());
  take(gone_, gone_count_);
  if (column < count_) take(new_, count_ - column);
  return all;
}

template <typename Field>
void RefinedBasis::combine_field(const Field& field, const Combination& combination) {
  const Eigen::Index moved = combination.of_others.cols();
  const Eigen::Index size = modes_.vectors.rows();
  auto& modes = field(modes_);
  auto& gone = field(gone_);
  for_each_panel(size, [&](Eigen::Index first, Eigen::Index rows) {
    const Eigen::MatrixXd after = combination.of(rows_of(field, first, rows));
    modes.middleRows(first, rows) =
        after.leftCols(after.cols() - moved)
            .template cast<typename std::remove_reference_t<decltype(modes)>::Scalar>();
    gone.block(first, 0, rows, moved) = after.rightCols(moved).template cast<float>();
  });
  field(new_).resize(0, 0);
}

/// Adds the columns and rows of the last columns to K and M.
/// @param products with the last columns
void RefinedBasis::project_new(const ElementOperator::Products& products) {
  const Eigen::Index more = products.forces.cols();
  const Eigen::Index before = count_ - more;
  Eigen::MatrixXd added = Eigen::MatrixXd::Zero(count_, 2 * more);
  for_each_panel(products.forces.rows(), [&](Eigen::Index first, Eigen::Index rows) {
    const Eigen::MatrixXd vectors = rows_of(kVectors, first, rows);
    multiply_transpose(1, vectors, products.forces.middleRows(first, rows), 1,
                       added.leftCols(more));
    multiply_transpose(1, vectors, products.momenta.middleRows(first, rows), 1,
                       added.rightCols(more));
  });
  ranks_.sum(added);
  const auto add = [&](const auto& columns, Eigen::MatrixXd& projected) {
    projected.block(0, before, count_, more) = columns;
    projected.block(before, 0, more, before) = columns.topRows(before).transpose();
  };
  add(added.leftCols(more), stiffness_);
  add(added.rightCols(more), mass_);
}

RefinedBasis::RefinedBasis(const Ranks& ranks, Eigen::Index size, Eigen::Index modes,
                           Eigen::Index directions)
    : ranks_(ranks),
      gone_{Eigen::MatrixXf(size, directions), Eigen::MatrixXf(size, directions),
            Eigen::MatrixXf(size, directions)},
      stiffness_(modes + 2 * directions, modes + 2 * directions),
      mass_(stiffness_.rows(), stiffness_.cols()) {}

void RefinedBasis::append(Eigen::MatrixXd vectors, ElementOperator::Products products) {
  Modes& block = count_ == 0 ? modes_ : new_;
  count_ += vectors.cols();
  block.vectors = std::move(vectors);
  project_new(products);
  block.forces = std::move(products.forces);
  block.momenta = products.momenta.cast<float>();
}

Eigen::MatrixXd RefinedBasis::combined(const Eigen::MatrixXd& combinations) const {
  Eigen::MatrixXd result(modes_.vectors.rows(), combinations.cols());
  for_each_panel(result.rows(), [&](Eigen::Index first, Eigen::Index rows) {
    multiply(1, rows_of(kVectors, first, rows), combinations, 0, result.middleRows(first, rows));
  });
  return result;
}

void RefinedBasis::combine(const Eigen::MatrixXd& of_modes, const Eigen::MatrixXd& of_others) {
  const Combination combination{of_modes, of_others};
  combine_field(kVectors, combination);
  combine_field(kForces, combination);
  combine_field(kMomenta, combination);
  const Eigen::MatrixXd all = combination.of(Eigen::MatrixXd::Identity(count_, count_));
  const Eigen::MatrixXd stiffness_after = all.transpose() * stiffness() * all;
  const Eigen::MatrixXd mass_after = all.transpose() * mass() * all;
  count_ = all.cols();
  gone_count_ = of_others.cols();
  stiffness_.topLeftCorner(count_, count_) = stiffness_after;
  mass_.topLeftCorner(count_, count_) = mass_after;
}

}  // namespace flexneck::fe_modal
