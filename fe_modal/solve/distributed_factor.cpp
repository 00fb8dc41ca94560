// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/solve/distributed_factor.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>
#include <numeric>
#include <string>
#include <utility>

#include "fe_modal/algebra/blas_kernels.h"
#include "fe_modal/algebra/cholesky_factor.h"
#include "fe_modal/algebra/cholmod_handles.h"
#include "fe_modal/algebra/inertia_count.h"
#include "fe_modal/solve/iterative/submatrix.h"
#include "fe_modal/system/elimination_order.h"
#include "geometry/foundation/available_memory.h"
#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {
namespace {

std::vector<std::int32_t> numbers_from_0(std::size_t count) {
  std::vector<std::int32_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

/// A part's matrix with the places of its factor's entries.
class PartAnalysis {
 public:
  PartAnalysis(const DistributedMatrix& matrix, const Separator& separator)
      : order_(matrix.is_in_order ? numbers_from_0(matrix.blocks.size())
                                  : order_of_part(matrix.graph, separator)),
        view_(cholmod_view(matrix.summand.get())),
        analysis_(view_, matrix.is_in_order ? CholmodOrder::numbering : CholmodOrder::exactly,
                  matrix.is_in_order ? std::span<const std::int32_t>() : order_) {
    for (const std::size_t p : separator.own_panels())
      kept_.push_back(separator.panels()[p].columns);
  }

  CholmodAnalysis& get() { return analysis_; }
  const std::vector<std::int32_t>& order() const { return order_; }
  /// Columns of the panels of the separator that the part has.
  const std::vector<int>& kept() const { return kept_; }

 private:
  std::vector<std::int32_t> order_;
  cholmod_sparse view_;
  CholmodAnalysis analysis_;
  std::vector<int> kept_;
};

/// Collective: analyses all parts that have blocks, and requires memory for their factors before
/// any is made.
void analyse(const DistributedMatrix& matrix, const Separator& separator,
             std::optional<PartAnalysis>& part, double bytes_per_entry, const std::string& what,
             const std::string& advice) {
  const Ranks& ranks = matrix.layout.ranks();
  const int beside = ranks.on_this_machine();
  ranks.together([&] {
    if (!matrix.blocks.empty()) part.emplace(matrix, separator);
  });
  ranks.together([&] {
    if (!part) return;
    const std::string where =
        beside > 1 ? " on the " + std::to_string(beside) + " ranks of this machine" : "";
    require_memory(what + where, bytes_per_entry * beside * part->get().nonzeros(), advice);
  });
}

/// Collective: the diagonal in the separator's rows.
Eigen::VectorXd diagonal_between(const DistributedMatrix& matrix, const Separator& separator) {
  Eigen::VectorXd diagonal = Eigen::VectorXd::Zero(separator.row_count());
  for (std::size_t k = 0; k < separator.rows().size(); ++k)
    diagonal[separator.rows()[k]] = matrix.summand.entry(
        separator.shared()[k / 3], static_cast<int>(k % 3), -1, static_cast<int>(k % 3));
  matrix.layout.ranks().sum(diagonal);
  return diagonal;
}

/// Adds a part's Schur complement to the panels, block by block, and lets the blocks go.
SeparatorFactor::AddSummand summands(const Separator& separator,
                                     SchurComplement<double>& complement) {
  return [&](std::size_t p, const DenseBlock<double>& sum) {
    const auto& own = separator.own_panels();
    const auto place = std::lower_bound(own.begin(), own.end(), p);
    if (place == own.end() || *place != p) return;
    std::vector<double> values =
        std::exchange(complement[static_cast<std::size_t>(place - own.begin())], {});
    const Panel& panel = separator.panels()[p];
    const auto begin =
        std::lower_bound(separator.rows().begin(), separator.rows().end(), panel.first);
    const auto rows = static_cast<int>(separator.rows().end() - begin);
    add_rows(1, DenseBlock<const double>{values.data(), rows, panel.columns, rows},
             {begin, separator.rows().end()}, panel, sum);
  };
}

std::size_t block_count(const DofLayout& layout) {
  return static_cast<std::size_t>(layout.dof_count() / 3);
}

/// Where in a rank's rows those of some blocks of its part are; -1: another rank's.
std::vector<Eigen::Index> own_rows(const DistributedMatrix& matrix,
                                   std::span<const std::int32_t> places) {
  std::vector<Eigen::Index> rows;
  for (const std::int32_t place : places) {
    const std::int32_t block = matrix.blocks[static_cast<std::size_t>(place)];
    const bool is_own = matrix.layout.owner(block) == matrix.layout.ranks().own();
    for (int a = 0; a < 3; ++a) rows.push_back(is_own ? 3 * matrix.layout.place(block) + a : -1);
  }
  return rows;
}

}  // namespace

std::vector<std::int32_t> order_of_part(const NodeGraph& graph, const Separator& separator) {
  std::vector<std::int32_t> order;
  if (!separator.inside().empty()) {
    for (const std::int32_t k : elimination_order_of(restrict_to(graph, separator.inside())))
      order.push_back(separator.inside()[static_cast<std::size_t>(k)]);
  }
  order.insert(order.end(), separator.shared().begin(), separator.shared().end());
  return order;
}

DistributedFactor::DistributedFactor(const DistributedMatrix& matrix, double shift)
    : ShiftInverse(shift, matrix.layout.ranks()),
      separator_(ranks(), block_count(matrix.layout), matrix.blocks) {
  std::optional<PartAnalysis> part;
  analyse(matrix, separator_, part, kBytesPerFactorEntry, "the factor",
          "take a coarser mesh or more machines");
  ranks().together([&] {
    if (!part) return;
    inside_ =
        SupernodalFactor<double>(part->get(), threads_in_blas(ranks().threads()), part->kept());
    inside_rows_ = own_rows(matrix, std::span(part->order()).first(separator_.inside().size()));
    shared_rows_ = own_rows(matrix, separator_.shared());
  });
  part.reset();
  SchurComplement<double> complement = inside_.take_complement();
  between_.emplace(ranks(), separator_.panels(), Pivots::positive,
                   diagonal_between(matrix, separator_), summands(separator_, complement));
  Eigen::VectorXd pivot = Eigen::VectorXd::Constant(1, -inside_.smallest_pivot());
  ranks().max(pivot);
  smallest_pivot_ = std::min(-pivot[0], between_->smallest_pivot());
  nonzeros_ = ranks().sum(static_cast<double>(inside_.value_count())) + between_->entry_count();
}

Eigen::MatrixXd DistributedFactor::solve(const Eigen::MatrixXd& right_hand_sides) const {
  const auto inside = static_cast<Eigen::Index>(inside_rows_.size());
  const auto shared = static_cast<Eigen::Index>(shared_rows_.size());
  Eigen::MatrixXd x(inside + shared, right_hand_sides.cols());
  x.topRows(inside) = right_hand_sides(inside_rows_, Eigen::all);
  x.bottomRows(shared).setZero();
  inside_.eliminate(x, ranks().threads());
  Eigen::MatrixXd between = Eigen::MatrixXd::Zero(separator_.row_count(), x.cols());
  for (std::size_t k = 0; k < shared_rows_.size(); ++k) {
    auto row = between.row(separator_.rows()[k]);
    row = x.row(inside + static_cast<Eigen::Index>(k));
    if (shared_rows_[k] >= 0) row += right_hand_sides.row(shared_rows_[k]);
  }
  ranks().sum(between);
  between_->solve(between);
  x.bottomRows(shared) = between(separator_.rows(), Eigen::all);
  inside_.substitute(x, ranks().threads());
  Eigen::MatrixXd solutions(right_hand_sides.rows(), x.cols());
  solutions(inside_rows_, Eigen::all) = x.topRows(inside);
  for (std::size_t k = 0; k < shared_rows_.size(); ++k) {
    if (shared_rows_[k] >= 0)
      solutions.row(shared_rows_[k]) = x.row(inside + static_cast<Eigen::Index>(k));
  }
  return solutions;
}

bool DistributedFactor::is_doubtful() const { return smallest_pivot_ < kSingularPivot; }

std::string DistributedFactor::describe() const {
  std::array<char, 80> text{};
  std::snprintf(text.data(), text.size(), "the factor has %.4g million entries on %d ranks",
                nonzeros_ / 1e6, ranks().count());
  return text.data();
}

std::optional<Eigen::Index> count_on_ranks(const DistributedMatrix& matrix) {
  const Ranks& ranks = matrix.layout.ranks();
  const Separator separator(ranks, block_count(matrix.layout), matrix.blocks);
  Inertia inside;
  bool is_counted = true;
  std::optional<PartAnalysis> part;
  analyse(matrix, separator, part, sizeof(double), "counting modes by inertia",
          "take a coarser mesh, or leave out modes.certify");
  ranks.together([&] {
    if (!part) return;
    const SupernodeTree tree(part->get().places(), part->get().block_size(), part->kept());
    const auto values = std::make_unique_for_overwrite<double[]>(tree.value_count());
    try {
      inside =
          factorise_with_signs(tree, part->get().lower_half(), {values.get(), tree.value_count()},
                               threads_in_blas(ranks.threads()));
      is_counted = inside.growth < kMaxGrowth;
    } catch (const ComputationError&) {  // a pivot is zero
      is_counted = false;
    }
  });
  part.reset();
  if (ranks.sum(is_counted ? 0.0 : 1.0) > 0) return std::nullopt;
  try {
    const SeparatorFactor between(ranks, separator.panels(), Pivots::of_any_sign,
                                  diagonal_between(matrix, separator),
                                  summands(separator, inside.complement));
    if (!(between.growth() < kMaxGrowth)) return std::nullopt;
    return static_cast<Eigen::Index>(ranks.sum(static_cast<double>(inside.negative))) +
           between.negative_pivots();
  } catch (const ComputationError&) {
    return std::nullopt;
  }
}

}  // namespace flexneck::fe_modal
