// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/solve/iterative/subdomain_factor.h"

#include <algorithm>

#include "fe_modal/algebra/cholmod_handles.h"

// The BLAS in single precision: PETSc declares that of its own precision only.
extern "C" {
void sgemm_(const char* transpose_a, const char* transpose_b, const int* m, const int* n,
            const int* k, const float* alpha, const float* a, const int* lda, const float* b,
            const int* ldb, const float* beta, float* c, const int* ldc);
void strsm_(const char* side, const char* triangle, const char* transpose, const char* diagonal,
            const int* m, const int* n, const float* alpha, const float* a, const int* lda,
            float* b, const int* ldb);
}

namespace flexneck::fe_modal {

SubdomainFactor::SubdomainFactor(const SymmetricMatrix& matrix,
                                 std::span<const std::int32_t> node_order) {
  CholmodSession session(CholmodOrder::given);
  session.get()->supernodal = CHOLMOD_SUPERNODAL;
  const cholmod_sparse view = cholmod_view(matrix.offsets(), matrix.columns(), matrix.values());
  CholmodFactor factor = analyse(view, order_of_dofs(node_order), session);
  factorise(view, factor, session);
  const auto* const permutation = static_cast<const int*>(factor->Perm);
  order_.assign(permutation, permutation + factor->n);
  const auto* const rows = static_cast<const int*>(factor->s);
  rows_.assign(rows, rows + factor->ssize);
  const auto* const values = static_cast<const double*>(factor->x);
  values_.resize(factor->xsize);
  std::transform(values, values + factor->xsize, values_.begin(),
                 [](double value) { return static_cast<float>(value); });
  const auto* const columns = static_cast<const int*>(factor->super);
  const auto* const row_lists = static_cast<const int*>(factor->pi);
  const auto* const blocks = static_cast<const int*>(factor->px);
  for (std::size_t k = 0; k < factor->nsuper; ++k) {
    supernodes_.push_back({columns[k], columns[k + 1] - columns[k], row_lists[k + 1] - row_lists[k],
                           static_cast<std::size_t>(row_lists[k]),
                           static_cast<std::size_t>(blocks[k])});
  }
}

void SubdomainFactor::forward(Eigen::MatrixXf& x) const {
  const auto size = static_cast<int>(x.rows());
  const auto count = static_cast<int>(x.cols());
  const float one = 1;
  const float zero = 0;
  Eigen::MatrixXf below;
  for (const Supernode& node : supernodes_) {
    const float* const block = values_.data() + node.block;
    float* const own = x.data() + node.first;
    strsm_("L", "L", "N", "N", &node.columns, &count, &one, block, &node.rows, own, &size);
    const int more = node.rows - node.columns;
    if (more == 0) continue;
    below.resize(more, count);
    sgemm_("N", "N", &more, &count, &node.columns, &one, block + node.columns, &node.rows, own,
           &size, &zero, below.data(), &more);
    const int* const rows = rows_.data() + node.row_list + node.columns;
    for (int j = 0; j < count; ++j) {
      for (int i = 0; i < more; ++i) x(rows[i], j) -= below(i, j);
    }
  }
}

void SubdomainFactor::backward(Eigen::MatrixXf& x) const {
  const auto size = static_cast<int>(x.rows());
  const auto count = static_cast<int>(x.cols());
  const float one = 1;
  const float minus_one = -1;
  Eigen::MatrixXf below;
  for (std::size_t k = supernodes_.size(); k-- > 0;) {
    const Supernode& node = supernodes_[k];
    const float* const block = values_.data() + node.block;
    float* const own = x.data() + node.first;
    const int more = node.rows - node.columns;
    if (more > 0) {
      below.resize(more, count);
      const int* const rows = rows_.data() + node.row_list + node.columns;
      for (int j = 0; j < count; ++j) {
        for (int i = 0; i < more; ++i) below(i, j) = x(rows[i], j);
      }
      sgemm_("T", "N", &node.columns, &count, &more, &minus_one, block + node.columns, &node.rows,
             below.data(), &more, &one, own, &size);
    }
    strsm_("L", "L", "T", "N", &node.columns, &count, &one, block, &node.rows, own, &size);
  }
}

void SubdomainFactor::add_solution(const Eigen::MatrixXf& residuals,
                                   const std::vector<std::int32_t>& nodes,
                                   Eigen::MatrixXf& result) const {
  std::vector<Eigen::Index> rows;  // of the whole, in the order of elimination
  rows.reserve(order_.size());
  for (const int dof : order_) {
    rows.push_back(3 * nodes[static_cast<std::size_t>(dof / 3)] + dof % 3);
  }
  Eigen::MatrixXf x = residuals(rows, Eigen::all);
  forward(x);
  backward(x);
  result(rows, Eigen::all) += x;
}

}  // namespace flexneck::fe_modal
