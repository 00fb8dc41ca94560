// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/solve/distributed/distributed_system.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <string>

#include "fe_modal/solve/distributed/share_message.h"
#include "mesher/partition/node_order.h"

namespace flexneck::fe_modal {
namespace {

constexpr const char* kSolving = "solving on all ranks";

/// The three numbers of each node out of those of the body.
std::vector<double> take(const double* values, const std::vector<std::int32_t>& nodes) {
  std::vector<double> result(3 * nodes.size());
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    std::copy_n(values + 3 * static_cast<std::ptrdiff_t>(nodes[k]), 3,
                result.begin() + static_cast<std::ptrdiff_t>(3 * k));
  }
  return result;
}

void add(const std::vector<double>& part, const std::vector<std::int32_t>& nodes, double* values) {
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    for (std::size_t a = 0; a < 3; ++a) {
      values[3 * static_cast<std::size_t>(nodes[k]) + a] += part[3 * k + a];
    }
  }
}

}  // namespace

/// A factor on all ranks.
class DistributedSystem::Inverse : public ShiftInverse {
 public:
  using ShiftInverse::solve;

  Inverse(const DistributedSystem& system, double shift)
      : ShiftInverse(shift), system_(system), number_(++system.last_factor_) {
    system_.team_.in_step([&] {
      system_.order_all({.task = Task::factorise, .number = number_, .value = shift});
      factor_ = system_.own_->factorise(system_.ranks_, MumpsFactor::Kind::definite, shift,
                                        system_.node_order_);
    });
  }
  ~Inverse() override {
    system_.team_.in_step([&] {
      system_.order_all({.task = Task::drop, .number = number_});
      factor_.reset();
    });
  }

  void solve(Vec right_hand_side, Vec solution) const override {
    require(VecCopy(right_hand_side, solution), kSolving);
    PetscScalar* values = nullptr;
    require(VecGetArray(solution, &values), kSolving);
    solve(values, 1);
    require(VecRestoreArray(solution, &values), kSolving);
  }
  Eigen::MatrixXd solve(const Eigen::MatrixXd& right_hand_sides) const override {
    Eigen::MatrixXd values = right_hand_sides;
    solve(values.data(), static_cast<int>(values.cols()));
    return values;
  }
  std::string describe() const override {
    std::array<char, 80> text{};
    std::snprintf(text.data(), text.size(), "the factor has %.4g million entries on %zu ranks",
                  factor_->nonzeros() / 1e6, system_.nodes_of_.size());
    return text.data();
  }

 private:
  void solve(double* values, int columns) const {
    system_.team_.in_step([&] {
      system_.order_all({.task = Task::solve, .number = number_, .columns = columns});
      factor_->solve(values, columns);
    });
  }

  const DistributedSystem& system_;
  int number_;
  std::unique_ptr<MumpsFactor> factor_;
};

DistributedSystem::DistributedSystem(const Ranks& team, const mesher::Mesh& mesh,
                                     const DofMap& dof_map, const FormulationChoice& formulation,
                                     const mesher::ElementPartition& partition,
                                     std::vector<std::int32_t> node_order)
    : team_(team),
      node_order_(std::move(node_order)),
      stiffness_(dof_map.dof_count(), [this](const Eigen::MatrixXd& columns) {
        Eigen::MatrixXd forces = Eigen::MatrixXd::Zero(columns.rows(), columns.cols());
        team_.in_step([&] {
          for (Eigen::Index k = 0; k < columns.cols(); ++k) {
            add_forces(columns.col(k).data(), forces.col(k).data());
          }
        });
        return forces;
      }) {
  std::vector<Share> shares = share_out(mesh, dof_map, partition);
  for (Share& share : shares) {
    share.formulation = formulation;
    nodes_of_.push_back(share.free_global);
  }
  team_.in_step([&] {
    assemble_shares(shares);
    gather_mass(mesh, shares);
  });
  const NodeGraph graph(mesh, dof_map);
  mass_ = std::make_unique<MassMatrix>(nodal_mass_, graph, dof_map);
  if (node_order_.empty()) {
    node_order_ = mesher::nested_dissection(graph.offsets(), graph.columns());
  }
}

void DistributedSystem::order_all(const Order& order) const {
  for (std::size_t worker = 1; worker < nodes_of_.size(); ++worker) {
    send_order(ranks_, static_cast<int>(worker), order);
  }
}

void DistributedSystem::assemble_shares(std::vector<Share>& shares) {
  for (std::size_t worker = 1; worker < shares.size(); ++worker) {
    send_order(ranks_, static_cast<int>(worker), {.task = Task::assemble});
    send(ranks_, static_cast<int>(worker), pack(shares[worker]));
    shares[worker].mesh = {};
  }
  together(ranks_, [&] { own_ = std::make_unique<PartialSystem>(shares[0]); });
}

void DistributedSystem::gather_mass(const mesher::Mesh& mesh, const std::vector<Share>& shares) {
  nodal_mass_ = zero_nodal_mass(NodeGraph(mesh));
  const NodalMass& own = own_->nodal_mass();
  add_mass(shares[0].nodes, own.outerIndexPtr(), own.innerIndexPtr(), own.valuePtr());
  own_->drop_nodal_mass();
  for (std::size_t worker = 1; worker < shares.size(); ++worker) {
    send_order(ranks_, static_cast<int>(worker), {.task = Task::send_mass});
    MessageReader message(receive(ranks_, static_cast<int>(worker)));
    const auto offsets = message.list<std::int32_t>();
    const auto columns = message.list<std::int32_t>();
    const auto values = message.list<double>();
    add_mass(shares[worker].nodes, offsets.data(), columns.data(), values.data());
  }
}

/// Columns ascend in a share as in the body.
void DistributedSystem::add_mass(const std::vector<std::int32_t>& nodes,
                                 const std::int32_t* offsets, const std::int32_t* columns,
                                 const double* values) {
  const std::int32_t* const own_columns = nodal_mass_.innerIndexPtr();
  for (std::size_t row = 0; row < nodes.size(); ++row) {
    const std::int32_t* place = own_columns + nodal_mass_.outerIndexPtr()[nodes[row]];
    const std::int32_t* const end = own_columns + nodal_mass_.outerIndexPtr()[nodes[row] + 1];
    for (std::int32_t k = offsets[row]; k < offsets[row + 1]; ++k) {
      place = std::lower_bound(place, end, nodes[static_cast<std::size_t>(columns[k])]);
      nodal_mass_.valuePtr()[place - own_columns] += values[k];
    }
  }
}

void DistributedSystem::add_forces(const double* x, double* y) const {
  for (std::size_t worker = 1; worker < nodes_of_.size(); ++worker) {
    send_order(ranks_, static_cast<int>(worker), {.task = Task::multiply});
    MessageWriter message;
    message.put(take(x, nodes_of_[worker]));
    send(ranks_, static_cast<int>(worker), message.bytes());
  }
  const std::vector<double> own = take(x, nodes_of_[0]);
  std::vector<double> result(own.size());
  own_->multiply_stiffness(own, result);
  add(result, nodes_of_[0], y);
  for (std::size_t worker = 1; worker < nodes_of_.size(); ++worker) {
    MessageReader message(receive(ranks_, static_cast<int>(worker)));
    add(message.list<double>(), nodes_of_[worker], y);
  }
}

std::unique_ptr<ShiftInverse> DistributedSystem::shift_inverse(double shift) const {
  return std::make_unique<Inverse>(*this, shift);
}

Eigen::Index DistributedSystem::eigenvalues_below(double sigma) const {
  Eigen::Index count = 0;
  team_.in_step([&] {
    order_all({.task = Task::count_below, .value = sigma});
    count = own_->factorise(ranks_, MumpsFactor::Kind::indefinite, sigma, node_order_)
                ->negative_pivots();
  });
  return count;
}

}  // namespace flexneck::fe_modal
