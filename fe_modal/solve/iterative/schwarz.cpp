// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/solve/iterative/schwarz.h"

#include <algorithm>
#include <span>
#include <utility>

#include "fe_modal/algebra/blas_kernels.h"
#include "fe_modal/algebra/matrix_product.h"
#include "fe_modal/solve/iterative/submatrix.h"
#include "geometry/foundation/in_parallel.h"
#include "mesher/partition/node_order.h"

namespace flexneck::fe_modal {

SchwarzPreconditioner::SchwarzPreconditioner(const CutBody& body, const PartMatrix& part,
                                             const PartMatrix& around)
    : ranks_(body.fields.ranks()),
      coarse_(body, part),
      exchange_(body.fields.layout(), rows_of(around.blocks)),
      subdomain_count_(body.subdomains.blocks.size()) {
  ranks_.together([&] {
    for (std::size_t s = 0; s < body.subdomains.blocks.size(); ++s) {
      const std::vector<std::int32_t>& subdomain = body.subdomains.blocks[s];
      if (body.rank_of_subdomain[s] != ranks_.own() || subdomain.empty()) continue;
      const std::vector<std::int32_t> nodes =
          extended(body.subdomains, s, around.graph, around.blocks);
      const NodeGraph graph = restrict_to(around.graph, nodes);
      SubdomainFactor factor(principal_part(around.matrix, graph, nodes),
                             mesher::nested_dissection(graph.offsets(), graph.columns()),
                             threads_in_blas(ranks_.threads()));
      nonzeros_ += factor.nonzeros();
      std::vector<Eigen::Index> rows = factor.rows_of(nodes);
      regions_.push_back({std::move(factor), std::move(rows)});
    }
  });
  nonzeros_ = ranks_.sum(nonzeros_);
}

Eigen::MatrixXd SchwarzPreconditioner::apply(const Eigen::MatrixXd& residuals) const {
  return with_unit_columns(ranks_, residuals,
                           [this](const Eigen::MatrixXd& scaled) { return apply_to_unit(scaled); });
}

Eigen::MatrixXd SchwarzPreconditioner::apply_to_unit(const Eigen::MatrixXd& residuals) const {
  const Eigen::MatrixXf local = exchange_.to_local(residuals).cast<float>();
  Eigen::MatrixXf sums = Eigen::MatrixXf::Zero(local.rows(), local.cols());
  // One for each thread at a time: all of them would be several times the field.
  for (auto rest = std::span(regions_); !rest.empty();) {
    const std::size_t count = std::min<std::size_t>(ranks_.threads(), rest.size());
    std::vector<Eigen::MatrixXf> solutions(count);
    in_parallel(count, ranks_.threads(), [&](std::size_t k) {
      solutions[k] = rest[k].factor.solve(local(rest[k].rows, Eigen::all));
    });
    for (std::size_t k = 0; k < count; ++k) sums(rest[k].rows, Eigen::all) += solutions[k];
    rest = rest.subspan(count);
  }
  Eigen::MatrixXf coarse = Eigen::MatrixXf::Zero(residuals.rows(), residuals.cols());
  coarse_.add_correction(residuals.cast<float>(), coarse);
  return exchange_.sum_to_own(sums.cast<double>()) + coarse.cast<double>();
}

}  // namespace flexneck::fe_modal
