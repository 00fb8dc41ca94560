// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/solve/distributed_factor.h"

#include <algorithm>
#include <numeric>
#include <string>
#include <type_traits>
#include <utility>

#include "fe_modal/algebra/blas_kernels.h"
#include "fe_modal/algebra/cholesky_factor.h"
#include "fe_modal/algebra/cholmod_handles.h"
#include "fe_modal/algebra/separator_factor.h"
#include "fe_modal/algebra/supernodal_factor.h"
#include "fe_modal/solve/iterative/submatrix.h"
#include "fe_modal/system/elimination_order.h"
#include "geometry/foundation/available_memory.h"
#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {
namespace {

template <typename Scalar>
constexpr double kBytesPerEntry =
    std::is_same_v<Scalar, float> ? kBytesPerSingleEntry : kBytesPerFactorEntry;

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

/// What a factor is made for, as is said where memory does not hold it.
struct Purpose {
  const char* what;
  const char* advice;
  Pivots pivots;
};
constexpr Purpose kForSolutions{"the factor", "take a coarser mesh or more machines",
                                Pivots::positive};
constexpr Purpose kForCount{"counting modes by inertia",
                            "take a coarser mesh, or leave out modes.certify", Pivots::of_any_sign};

/// Collective: analyses all parts that have blocks, and requires memory for their factors before
/// any is made.
void analyse(const DistributedMatrix& matrix, const Separator& separator,
             std::optional<PartAnalysis>& part, double bytes_per_entry, const Purpose& purpose) {
  const Ranks& ranks = matrix.layout.ranks();
  const int beside = ranks.on_this_machine();
  ranks.together([&] {
    if (!matrix.blocks.empty()) part.emplace(matrix, separator);
  });
  ranks.together([&] {
    if (!part) return;
    const std::string where =
        beside > 1 ? " on the " + std::to_string(beside) + " ranks of this machine" : "";
    require_memory(purpose.what + where, bytes_per_entry * beside * part->get().nonzeros(),
                   purpose.advice);
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
template <typename Scalar>
typename SeparatorFactor<Scalar>::AddSummand summands(const Separator& separator,
                                                      SchurComplement<Scalar>& complement) {
  return [&](std::size_t p, const DenseBlock<Scalar>& sum) {
    const auto& own = separator.own_panels();
    const auto place = std::lower_bound(own.begin(), own.end(), p);
    if (place == own.end() || *place != p) return;
    const std::vector<Scalar> values =
        std::exchange(complement[static_cast<std::size_t>(place - own.begin())], {});
    const Panel& panel = separator.panels()[p];
    const auto begin =
        std::lower_bound(separator.rows().begin(), separator.rows().end(), panel.first);
    const auto rows = static_cast<int>(separator.rows().end() - begin);
    add_rows(Scalar(1), DenseBlock<const Scalar>{values.data(), rows, panel.columns, rows},
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

/// A = L S L^T on all ranks.
template <typename Scalar>
class DistributedFactor {
 public:
  /// Collective.
  explicit DistributedFactor(const DistributedMatrix& matrix,
                             const Purpose& purpose = kForSolutions);

  /// A^-1 times each column, (own dofs, k). Collective.
  Eigen::MatrixXd solution(const Eigen::MatrixXd& right_hand_sides) const;
  /// As SupernodalFactor's, of all ranks.
  double smallest_pivot() const { return smallest_pivot_; }
  Eigen::Index negative_pivots() const;
  /// "the factor has 12.3 million entries on 4 ranks"
  std::string entries_text() const;

 private:
  Ranks ranks_;
  Separator separator_;
  /// Where in this rank's rows those of the factor are; -1: another rank's.
  std::vector<Eigen::Index> inside_rows_;
  std::vector<Eigen::Index> shared_rows_;
  SupernodalFactor<Scalar> inside_;
  std::optional<SeparatorFactor<Scalar>> between_;
  double smallest_pivot_ = 1;
  double nonzeros_ = 0;
};

template <typename Scalar>
DistributedFactor<Scalar>::DistributedFactor(const DistributedMatrix& matrix,
                                             const Purpose& purpose)
    : ranks_(matrix.layout.ranks()), separator_(ranks_, block_count(matrix.layout), matrix.blocks) {
  std::optional<PartAnalysis> part;
  analyse(matrix, separator_, part, kBytesPerEntry<Scalar>, purpose);
  ranks_.together([&] {
    if (!part) return;
    inside_ = SupernodalFactor<Scalar>(part->get(), threads_in_blas(ranks_.threads()), part->kept(),
                                       purpose.pivots);
    inside_rows_ = own_rows(matrix, std::span(part->order()).first(separator_.inside().size()));
    shared_rows_ = own_rows(matrix, separator_.shared());
  });
  part.reset();
  matrix.summand.free_columns();  // room for what is between the parts; products do without
  SchurComplement<Scalar> complement = inside_.take_complement();
  between_.emplace(ranks_, separator_.panels(), purpose.pivots,
                   diagonal_between(matrix, separator_), summands(separator_, complement));
  Eigen::VectorXd pivot = Eigen::VectorXd::Constant(1, -inside_.smallest_pivot());
  ranks_.max(pivot);
  smallest_pivot_ = std::min(-pivot[0], between_->smallest_pivot());
  nonzeros_ = ranks_.sum(static_cast<double>(inside_.value_count())) + between_->entry_count();
}

template <typename Scalar>
Eigen::MatrixXd DistributedFactor<Scalar>::solution(const Eigen::MatrixXd& right_hand_sides) const {
  const auto inside = static_cast<Eigen::Index>(inside_rows_.size());
  const auto shared = static_cast<Eigen::Index>(shared_rows_.size());
  Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic> x(inside + shared, right_hand_sides.cols());
  x.topRows(inside) = right_hand_sides(inside_rows_, Eigen::all).template cast<Scalar>();
  x.bottomRows(shared).setZero();
  inside_.eliminate(x, ranks_.threads());
  Eigen::MatrixXd between = Eigen::MatrixXd::Zero(separator_.row_count(), x.cols());
  for (std::size_t k = 0; k < shared_rows_.size(); ++k) {
    auto row = between.row(separator_.rows()[k]);
    row = x.row(inside + static_cast<Eigen::Index>(k)).template cast<double>();
    if (shared_rows_[k] >= 0) row += right_hand_sides.row(shared_rows_[k]);
  }
  ranks_.sum(between);
  between_->solve(between);
  const Eigen::MatrixXd shared_x = between(separator_.rows(), Eigen::all);
  x.bottomRows(shared) = shared_x.template cast<Scalar>();
  inside_.substitute(x, ranks_.threads());
  Eigen::MatrixXd solutions(right_hand_sides.rows(), x.cols());
  solutions(inside_rows_, Eigen::all) = x.topRows(inside).template cast<double>();
  for (std::size_t k = 0; k < shared_rows_.size(); ++k) {
    if (shared_rows_[k] >= 0)
      solutions.row(shared_rows_[k]) = shared_x.row(static_cast<Eigen::Index>(k));
  }
  return solutions;
}

template <typename Scalar>
Eigen::Index DistributedFactor<Scalar>::negative_pivots() const {
  return static_cast<Eigen::Index>(ranks_.sum(static_cast<double>(inside_.negative_pivots()))) +
         between_->negative_pivots();
}

template <typename Scalar>
std::string DistributedFactor<Scalar>::entries_text() const {
  return fe_modal::entries_text(nonzeros_) + " on " + std::to_string(ranks_.count()) + " ranks";
}

template <typename Scalar>
std::optional<Eigen::Index> count_in(const DistributedMatrix& matrix, Mat product,
                                     const KnownVectors& known) {
  try {
    const DistributedFactor<Scalar> factor(matrix, kForCount);
    const auto inverse = [&](const Eigen::MatrixXd& x) { return factor.solution(x); };
    return count_by_factor(matrix.layout.ranks(), product, {inverse, factor.negative_pivots()},
                           known);
  } catch (const OutOfMemory&) {
    throw;
  } catch (const ComputationError&) {  // a pivot is zero
    return std::nullopt;
  }
}

/// In double precision.
class DistributedInverse : public ShiftInverse {
 public:
  DistributedInverse(const DistributedMatrix& matrix, double shift)
      : ShiftInverse(shift, matrix.layout.ranks()), factor_(matrix) {}

  Eigen::MatrixXd solve(const Eigen::MatrixXd& right_hand_sides) const override {
    return factor_.solution(right_hand_sides);
  }
  bool is_doubtful() const override { return factor_.smallest_pivot() < kSingularPivot; }
  std::string describe() const override { return factor_.entries_text(); }

 private:
  DistributedFactor<double> factor_;
};

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

std::unique_ptr<ShiftInverse> make_shift_inverse(const DistributedMatrix& matrix,
                                                 const Matrices& matrices, double shift,
                                                 SingleInverse::InDouble make_in_double) {
  try {
    const auto single = std::make_shared<const DistributedFactor<float>>(matrix);
    if (single->smallest_pivot() > kDoubtfulSinglePivot) {
      return std::make_unique<SingleInverse>(
          SingleFactor{[single](const Eigen::MatrixXd& x) { return single->solution(x); },
                       single->entries_text()},
          matrices, shift, std::move(make_in_double), matrix.layout.ranks());
    }
  } catch (const OutOfMemory&) {
    throw;
  } catch (const ComputationError&) {  // as factorise_in_single(), on all ranks
  }
  return make_distributed_in_double(matrix, shift);
}

std::unique_ptr<ShiftInverse> make_distributed_in_double(const DistributedMatrix& matrix,
                                                         double shift) {
  return std::make_unique<DistributedInverse>(matrix, shift);
}

std::optional<Eigen::Index> count_on_ranks(const DistributedMatrix& matrix, Mat product,
                                           const KnownVectors& known) {
  if (const auto counted = count_in<float>(matrix, product, known)) return counted;
  return count_in<double>(matrix, product, known);
}

}  // namespace flexneck::fe_modal
