// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/algebra/separator_factor.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "fe_modal/algebra/blas_kernels.h"
#include "fe_modal/algebra/block_elimination.h"
#include "fe_modal/algebra/communicator.h"
#include "fe_modal/algebra/signed_cholesky.h"
#include "fe_modal/algebra/supernode_tree.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/in_parallel.h"

namespace flexneck::fe_modal {
namespace {

constexpr auto kLanesOfSolve = static_cast<Eigen::Index>(kColumnsTogether);

int row_count(const Panel& panel) { return static_cast<int>(panel.rows.size()); }

std::size_t size_of(const Panel& panel) { return panel.rows.size() * as_index(panel.columns); }

template <typename Scalar>
DenseBlock<Scalar> block(const Panel& panel, std::vector<Scalar>& values) {
  return {values.data(), row_count(panel), panel.columns, row_count(panel)};
}

template <typename Scalar>
MPI_Datatype mpi_type() {
  return std::is_same_v<Scalar, float> ? MPI_FLOAT : MPI_DOUBLE;
}

}  // namespace

template <typename Scalar>
void add_rows(Scalar factor, const DenseBlock<const Scalar>& values, std::span<const int> rows,
              const Panel& panel, const DenseBlock<Scalar>& sum) {
  int place = 0;
  for (int i = 0; i < values.rows; ++i) {
    while (panel.rows[as_index(place)] != rows[as_index(i)]) ++place;
    for (int j = 0; j < values.columns; ++j) sum.column(j)[place] += factor * values.column(j)[i];
  }
}

template <typename Scalar>
class SeparatorFactor<Scalar>::Elimination {
 public:
  Elimination(SeparatorFactor& factor, Pivots pivots, const Eigen::VectorXd& diagonal)
      : factor_(factor), pivots_(pivots), diagonal_(diagonal) {
    factor_.ranks_.together([&] {
      std::size_t largest = 0;
      for (const Panel& panel : panels()) largest = std::max(largest, size_of(panel));
      received_.resize(largest);
      products_.resize(std::max(1U, threads_in_blas(factor_.ranks_.threads())));
      for (std::vector<Scalar>& product : products_) product.reserve(largest);
    });
  }

  void add(const AddSummand& add_to) {
    for (std::size_t p = 0; p < panels().size(); ++p) {
      const Panel& panel = panels()[p];
      std::fill(received_.begin(), received_.end(), Scalar(0));
      add_to(p, block(panel, received_));
      // Not before: the summand that add_to() has let go leaves room.
      if (is_own(p)) factor_.values_[p].resize(size_of(panel));
      require_mpi(MPI_Reduce(received_.data(), is_own(p) ? factor_.values_[p].data() : nullptr,
                             static_cast<int>(size_of(panel)), mpi_type<Scalar>(), MPI_SUM,
                             panel.owner, ranks()));
    }
  }

  void run() {
    for (std::size_t p = 0; p < panels().size(); ++p) {
      const bool has_negative = factorise(p);
      const DenseBlock<const Scalar> values = send(p);
      note_pivots(panels()[p], values);
      update_from(p, values, has_negative);
    }
  }

 private:
  const std::vector<Panel>& panels() const { return factor_.panels_; }
  MPI_Comm ranks() const { return communicator(factor_.ranks_); }
  bool is_own(std::size_t p) const { return panels()[p].owner == factor_.ranks_.own(); }

  std::span<Scalar> signs_of(const Panel& panel) const {
    return std::span(factor_.signs_).subspan(as_index(panel.first), as_index(panel.columns));
  }

  /// By its owner; fails on all ranks.
  bool factorise(std::size_t p) {
    const Panel& panel = panels()[p];
    constexpr int kFailed = 2;
    int outcome = 0;
    if (is_own(p)) {
      const DenseBlock<Scalar> all = block(panel, factor_.values_[p]);
      const DenseBlock<Scalar> diagonal = all.part(0, 0, panel.columns, panel.columns);
      const DenseBlock<Scalar> below =
          all.part(panel.columns, 0, all.rows - panel.columns, panel.columns);
      try {
        outcome = factorise_diagonal(diagonal, pivots_, signs_of(panel), workspace_) ? 1 : 0;
        if (below.rows > 0) divide_by_transpose(DenseBlock<const Scalar>(diagonal), below);
        if (outcome == 1) turn_columns<Scalar>(below, signs_of(panel));
      } catch (const ComputationError&) {
        outcome = kFailed;
      }
    }
    require_mpi(MPI_Bcast(&outcome, 1, MPI_INT, panel.owner, ranks()));
    if (outcome == kFailed) throw ComputationError(kNotDefinite);
    if (outcome == 1) {
      require_mpi(MPI_Bcast(signs_of(panel).data(), panel.columns, mpi_type<Scalar>(), panel.owner,
                            ranks()));
    }
    return outcome == 1;
  }

  DenseBlock<const Scalar> send(std::size_t p) {
    const Panel& panel = panels()[p];
    std::vector<Scalar>& values = is_own(p) ? factor_.values_[p] : received_;
    require_mpi(MPI_Bcast(values.data(), static_cast<int>(size_of(panel)), mpi_type<Scalar>(),
                          panel.owner, ranks()));
    return block(panel, values);
  }

  void note_pivots(const Panel& panel, const DenseBlock<const Scalar>& values) {
    for (int j = 0; j < panel.columns; ++j) {
      const double root = values.column(j)[j];
      const double share = root * root / std::abs(diagonal_[panel.first + j]);
      factor_.smallest_pivot_ = std::min(factor_.smallest_pivot_, share);
    }
  }

  void update_from(std::size_t from, const DenseBlock<const Scalar>& values, bool has_negative) {
    const Panel& panel = panels()[from];
    std::vector<std::size_t> targets;
    for (std::size_t p = from + 1; p < panels().size(); ++p) {
      if (is_own(p) && std::binary_search(panel.rows.begin(), panel.rows.end(), panels()[p].first))
        targets.push_back(p);
    }
    const std::span<const Scalar> signs =
        has_negative ? std::span<const Scalar>(signs_of(panel)) : std::span<const Scalar>();
    in_parallel(std::min(products_.size(), targets.size()), static_cast<unsigned>(products_.size()),
                [&](std::size_t thread) {
                  call_blas_alone();
                  for (std::size_t k = thread; k < targets.size(); k += products_.size())
                    update(targets[k], panel, values, signs, products_[thread]);
                });
  }

  /// Subtracts L_i S L_j^T of the panel's rows j that are columns of the target.
  void update(std::size_t target, const Panel& panel, const DenseBlock<const Scalar>& values,
              std::span<const Scalar> signs, std::vector<Scalar>& workspace) {
    const Panel& into = panels()[target];
    const auto begin = std::lower_bound(panel.rows.begin(), panel.rows.end(), into.first);
    const int first = static_cast<int>(begin - panel.rows.begin());
    const DenseBlock<const Scalar> rows =
        values.part(first, 0, values.rows - first, values.columns);
    const DenseBlock<const Scalar> columns = values.part(first, 0, into.columns, values.columns);
    const DenseBlock<Scalar> product = room_for(rows.rows, into.columns, workspace);
    std::vector<Scalar> turned;
    multiply_with_signs(Scalar(1), rows, signs, columns, Scalar(0), product, turned);
    add_rows<Scalar>(-1, DenseBlock<const Scalar>(product), {begin, panel.rows.end()}, into,
                     block(into, factor_.values_[target]));
  }

  SeparatorFactor& factor_;
  Pivots pivots_;
  const Eigen::VectorXd& diagonal_;
  std::vector<Scalar> received_;               ///< a panel
  std::vector<std::vector<Scalar>> products_;  ///< of each thread
  std::vector<Scalar> workspace_;
};

template <typename Scalar>
SeparatorFactor<Scalar>::SeparatorFactor(const Ranks& ranks, const std::vector<Panel>& panels,
                                         Pivots pivots, const Eigen::VectorXd& diagonal,
                                         const AddSummand& add)
    : ranks_(ranks),
      panels_(panels),
      values_(panels.size()),
      signs_(static_cast<std::size_t>(diagonal.size()), Scalar(1)) {
  Elimination elimination(*this, pivots, diagonal);
  elimination.add(add);
  elimination.run();
}

/// Eight columns on their way through the panels.
template <typename Scalar>
class SeparatorFactor<Scalar>::Solve {
 public:
  Solve(const SeparatorFactor& factor, Eigen::Index rows)
      : factor_(factor), x_(static_cast<std::size_t>(rows)), panel_x_(x_.size()) {}

  auto columns() {
    using RowMajor = Eigen::Matrix<Scalar, Eigen::Dynamic, kLanesOfSolve, Eigen::RowMajor>;
    return Eigen::Map<RowMajor>(x_.front().value, static_cast<Eigen::Index>(x_.size()),
                                kLanesOfSolve);
  }

  void run() {
    for (std::size_t p = 0; p < factor_.panels_.size(); ++p) forward(p);
    for (std::size_t p = factor_.panels_.size(); p-- > 0;) backward(p);
  }

 private:
  void forward(std::size_t p) {
    const Panel& panel = factor_.panels_[p];
    if (is_own(panel)) {
      std::copy_n(x_.begin() + panel.first, panel.columns, panel_x_.begin());
      std::fill_n(panel_x_.begin() + panel.columns, row_count(panel) - panel.columns,
                  RowOf<Scalar>{});
      eliminate(factor_block(p), panel_x_.data());
    }
    send(panel, row_count(panel));
    auto all = columns();
    for (std::size_t i = as_index(panel.columns); i < panel.rows.size(); ++i)
      all.row(panel.rows[i]) +=
          Eigen::Map<Eigen::Matrix<Scalar, 1, kLanesOfSolve>>(panel_x_[i].value);
  }

  void backward(std::size_t p) {
    const Panel& panel = factor_.panels_[p];
    if (is_own(panel)) {
      std::transform(panel.rows.begin(), panel.rows.end(), panel_x_.begin(),
                     [&](int row) { return x_[as_index(row)]; });
      turn_rows(panel);
      substitute(factor_block(p), panel_x_.data());
    }
    send(panel, panel.columns);
  }

  void turn_rows(const Panel& panel) {
    for (int k = 0; k < panel.columns; ++k) {
      if (factor_.signs_[as_index(panel.first + k)] > 0) continue;
      for (Scalar& value : panel_x_[as_index(k)].value) value = -value;
    }
  }

  bool is_own(const Panel& panel) const { return panel.owner == factor_.ranks_.own(); }
  FactorBlock<Scalar> factor_block(std::size_t p) const {
    const Panel& panel = factor_.panels_[p];
    return {factor_.values_[p].data(), row_count(panel), panel.columns};
  }

  /// The first rows of the panel to all ranks, of which those of its columns are final.
  void send(const Panel& panel, int rows) {
    require_mpi(MPI_Bcast(panel_x_.front().value, rows * static_cast<int>(kLanesOfSolve),
                          mpi_type<Scalar>(), panel.owner, communicator(factor_.ranks_)));
    std::copy_n(panel_x_.begin(), panel.columns, x_.begin() + panel.first);
  }

  const SeparatorFactor& factor_;
  std::vector<RowOf<Scalar>> x_;
  std::vector<RowOf<Scalar>> panel_x_;
};

template <typename Scalar>
void SeparatorFactor<Scalar>::solve(Eigen::MatrixXd& x) const {
  if (x.size() == 0) return;
  Solve eight(*this, x.rows());
  for (Eigen::Index first = 0; first < x.cols(); first += kLanesOfSolve) {
    const Eigen::Index width = std::min(kLanesOfSolve, x.cols() - first);
    eight.columns().setZero();
    eight.columns().leftCols(width) = x.middleCols(first, width).cast<Scalar>();
    eight.run();
    x.middleCols(first, width) = eight.columns().leftCols(width).template cast<double>();
  }
}

template <typename Scalar>
Eigen::Index SeparatorFactor<Scalar>::negative_pivots() const {
  return std::count(signs_.begin(), signs_.end(), Scalar(-1));
}

template <typename Scalar>
double SeparatorFactor<Scalar>::entry_count() const {
  double count = 0;
  for (const Panel& panel : panels_)
    count += static_cast<double>(size_of(panel)) - 0.5 * panel.columns * (panel.columns - 1);
  return count;
}

template void add_rows(double, const DenseBlock<const double>&, std::span<const int>, const Panel&,
                       const DenseBlock<double>&);
template void add_rows(float, const DenseBlock<const float>&, std::span<const int>, const Panel&,
                       const DenseBlock<float>&);
template class SeparatorFactor<double>;
template class SeparatorFactor<float>;

}  // namespace flexneck::fe_modal
