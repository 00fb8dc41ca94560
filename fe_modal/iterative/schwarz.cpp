// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/iterative/schwarz.h"

#include <algorithm>

#include "mesher/partition/node_order.h"

namespace flexneck::fe_modal {
namespace {

/// The graph between some of the nodes, by their places in the list.
NodeGraph restrict_to(const NodeGraph& graph, const std::vector<std::int32_t>& nodes) {
  std::vector<std::int32_t> offsets = {0};
  std::vector<std::int32_t> columns;
  for (const std::int32_t node : nodes) {
    auto place = nodes.begin();
    for (const std::int32_t other : graph.neighbours(node)) {
      place = std::lower_bound(place, nodes.end(), other);
      if (place == nodes.end()) break;
      if (*place == other) columns.push_back(static_cast<std::int32_t>(place - nodes.begin()));
    }
    offsets.push_back(static_cast<std::int32_t>(columns.size()));
  }
  return {std::move(offsets), std::move(columns)};
}

/// The rows and columns of some nodes.
SymmetricMatrix principal_part(const SymmetricMatrix& matrix, const NodeGraph& part,
                               const std::vector<std::int32_t>& nodes) {
  SymmetricMatrix result(part);
  for (std::int32_t row = 0; row < part.node_count(); ++row) {
    const std::int32_t node = nodes[static_cast<std::size_t>(row)];
    const auto later = matrix.later(node);
    for (int a = 0; a < 3; ++a) {
      for (int b = a; b < 3; ++b) result.entry(row, a, -1, b) = matrix.entry(node, a, -1, b);
    }
    const auto own = result.later(row);
    for (std::size_t k = 0; k < own.size(); ++k) {
      const auto place =
          std::lower_bound(later.begin(), later.end(), nodes[static_cast<std::size_t>(own[k])]) -
          later.begin();
      for (int a = 0; a < 3; ++a) {
        for (int b = 0; b < 3; ++b) {
          result.entry(row, a, static_cast<std::ptrdiff_t>(k), b) = matrix.entry(node, a, place, b);
        }
      }
    }
  }
  return result;
}

using SixMotions = Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>;

/// y = K x where x is zero but on some nodes.
class SparseProduct {
 public:
  SparseProduct(const SymmetricMatrix& matrix, const NodeGraph& graph)
      : matrix_(matrix),
        graph_(graph),
        x_(SixMotions::Zero(matrix.size(), 6)),
        y_(SixMotions::Zero(matrix.size(), 6)),
        is_reached_(static_cast<std::size_t>(graph.node_count())) {}

  const SixMotions& multiply(const Region& region) {
    for (const std::int32_t node : reached_) {
      y_.middleRows<3>(3 * node).setZero();
      x_.middleRows<3>(3 * node).setZero();
      is_reached_[static_cast<std::size_t>(node)] = false;
    }
    reached_.clear();
    for (std::size_t k = 0; k < region.nodes.size(); ++k) {
      x_.middleRows<3>(3 * region.nodes[k]) =
          region.motions.middleRows<3>(static_cast<Eigen::Index>(3 * k));
      for (const std::int32_t node : graph_.neighbours(region.nodes[k])) {
        if (is_reached_[static_cast<std::size_t>(node)]) continue;
        is_reached_[static_cast<std::size_t>(node)] = true;
        reached_.push_back(node);
      }
    }
    const auto offsets = matrix_.offsets();
    const auto columns = matrix_.columns();
    const auto values = matrix_.values();
    for (const std::int32_t node : reached_) {
      for (int row = 3 * node; row < 3 * node + 3; ++row) {
        for (auto k = static_cast<std::size_t>(offsets[static_cast<std::size_t>(row)]);
             k < static_cast<std::size_t>(offsets[static_cast<std::size_t>(row) + 1]); ++k) {
          y_.row(row) += values[k] * x_.row(columns[k]);
          if (columns[k] != row) y_.row(columns[k]) += values[k] * x_.row(row);
        }
      }
    }
    return y_;
  }

 private:
  const SymmetricMatrix& matrix_;
  const NodeGraph& graph_;
  SixMotions x_;
  SixMotions y_;
  std::vector<bool> is_reached_;
  std::vector<std::int32_t> reached_;
};

template <typename Field>
Eigen::MatrixXd take(const Field& field, const std::vector<std::int32_t>& nodes) {
  Eigen::MatrixXd result(3 * static_cast<Eigen::Index>(nodes.size()), field.cols());
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    result.template middleRows<3>(static_cast<Eigen::Index>(3 * k)) =
        field.template middleRows<3>(3 * nodes[k]);
  }
  return result;
}

void add(const Eigen::MatrixXd& part, const std::vector<std::int32_t>& nodes,
         Eigen::MatrixXd& field) {
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    field.middleRows<3>(3 * nodes[k]) += part.middleRows<3>(static_cast<Eigen::Index>(3 * k));
  }
}

}  // namespace

SchwarzPreconditioner::SchwarzPreconditioner(const SymmetricMatrix& stiffness,
                                             const NodeGraph& graph, std::vector<Region> subdomains,
                                             std::vector<Region> more)
    : subdomain_count_(subdomains.size()), regions_(std::move(subdomains)) {
  for (const Region& region : regions_) factorise(stiffness, graph, region);
  for (Region& region : more) regions_.push_back(std::move(region));
  make_coarse(stiffness, graph);
}

void SchwarzPreconditioner::factorise(const SymmetricMatrix& stiffness, const NodeGraph& graph,
                                      const Region& region) {
  const NodeGraph part = restrict_to(graph, region.nodes);
  const SymmetricMatrix matrix = principal_part(stiffness, part, region.nodes);
  factors_.push_back(std::make_unique<CholeskyFactor>(
      matrix.get(), 0, mesher::nested_dissection(part.offsets(), part.columns())));
  nonzeros_ += factors_.back()->nonzeros();
}

void SchwarzPreconditioner::make_coarse(const SymmetricMatrix& stiffness, const NodeGraph& graph) {
  const auto size = static_cast<Eigen::Index>(6 * regions_.size());
  Eigen::MatrixXd matrix(size, size);
  SparseProduct product(stiffness, graph);
  for (std::size_t i = 0; i < regions_.size(); ++i) {
    const SixMotions& forces = product.multiply(regions_[i]);
    for (std::size_t j = i; j < regions_.size(); ++j) {  // the lower half is enough
      matrix.block<6, 6>(static_cast<Eigen::Index>(6 * j), static_cast<Eigen::Index>(6 * i)) =
          regions_[j].motions.transpose() * take(forces, regions_[j].nodes);
    }
  }
  // Motions of parts may be sums of those of subdomains; this much more keeps the pivots apart.
  constexpr double kApart = 1e-10;
  matrix.diagonal() *= 1 + kApart;
  coarse_.compute(matrix);
}

Eigen::MatrixXd SchwarzPreconditioner::apply(const Eigen::MatrixXd& residuals) const {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(residuals.rows(), residuals.cols());
  Eigen::MatrixXd loads(6 * static_cast<Eigen::Index>(regions_.size()), residuals.cols());
  for (std::size_t i = 0; i < regions_.size(); ++i) {
    const Eigen::MatrixXd own = take(residuals, regions_[i].nodes);
    loads.middleRows<6>(static_cast<Eigen::Index>(6 * i)) = regions_[i].motions.transpose() * own;
    if (i < subdomain_count_) add(factors_[i]->solve(own), regions_[i].nodes, result);
  }
  const Eigen::MatrixXd motion = coarse_.solve(loads);
  for (std::size_t i = 0; i < regions_.size(); ++i) {
    add(regions_[i].motions * motion.middleRows<6>(static_cast<Eigen::Index>(6 * i)),
        regions_[i].nodes, result);
  }
  return result;
}

}  // namespace flexneck::fe_modal
