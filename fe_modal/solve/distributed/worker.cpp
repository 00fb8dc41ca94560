// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/solve/distributed/worker.h"

#include "fe_modal/solve/distributed/share_message.h"
#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {
namespace {

constexpr int kLeader = 0;

/// Whether all ranks learn of a failure, or rank 0 would wait for an answer.
bool fails_on_all_ranks(Task task) { return task != Task::send_mass && task != Task::multiply; }

}  // namespace

void send_order(MPI_Comm ranks, int to, const Order& order) {
  MessageWriter message;
  message.put(order);
  send(ranks, to, message.bytes());
}

void Worker::run() {
  for (;;) {
    const auto order = MessageReader(receive(ranks_, kLeader)).get<Order>();
    if (order.task == Task::go_home) return;
    try {
      carry_out(order);
    } catch (const ComputationError&) {
      if (!fails_on_all_ranks(order.task)) throw;
      // Rank 0 has the same error and says so; it will not build on what failed.
    }
  }
}

void Worker::carry_out(const Order& order) {
  switch (order.task) {
    case Task::assemble: {
      Bytes share = receive(ranks_, kLeader);
      together(ranks_, [&] {
        factors_.clear();
        system_.reset();
        system_.emplace(unpack_share(std::move(share)));
      });
      return;
    }
    case Task::send_mass:
      return send_mass();
    case Task::multiply:
      return multiply();
    case Task::factorise:
      factors_[order.number] =
          system_->factorise(ranks_, MumpsFactor::Kind::definite, order.value, {});
      return;
    case Task::solve:
      return factors_.at(order.number)->solve(nullptr, order.columns);
    case Task::drop:
      factors_.erase(order.number);
      return;
    case Task::count_below:
      static_cast<void>(system_->factorise(ranks_, MumpsFactor::Kind::indefinite, order.value, {}));
      return;
    case Task::go_home:
      return;
  }
}

void Worker::send_mass() const {
  const NodalMass& mass = system_->nodal_mass();
  MessageWriter message;
  message.put(
      std::vector<std::int32_t>(mass.outerIndexPtr(), mass.outerIndexPtr() + mass.outerSize() + 1));
  message.put(
      std::vector<std::int32_t>(mass.innerIndexPtr(), mass.innerIndexPtr() + mass.nonZeros()));
  message.put(std::vector<double>(mass.valuePtr(), mass.valuePtr() + mass.nonZeros()));
  send(ranks_, kLeader, message.bytes());
}

void Worker::multiply() const {
  const auto x = MessageReader(receive(ranks_, kLeader)).list<double>();
  std::vector<double> y(x.size());
  system_->multiply_stiffness(x, y);
  MessageWriter message;
  message.put(y);
  send(ranks_, kLeader, message.bytes());
}

}  // namespace flexneck::fe_modal
