// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <memory>
#include <optional>

#include "fe_modal/solve/distributed/messages.h"
#include "fe_modal/solve/distributed/partial_system.h"

namespace flexneck::fe_modal {

/// What rank 0 asks of the others. Each order but `drop` and `go_home` is carried out by all ranks,
/// rank 0 too.
enum class Task {
  assemble,     ///< the share that follows
  send_mass,    ///< the nodal mass to rank 0
  multiply,     ///< receive x, send K x
  factorise,    ///< K - value M, under the number
  solve,        ///< with the factor of that number; `columns` right-hand sides
  drop,         ///< the factor of that number
  count_below,  ///< eigenvalues below the value, by inertia
  go_home
};

struct Order {
  Task task = Task::go_home;
  int number = 0;
  int columns = 0;
  double value = 0;
};

void send_order(MPI_Comm ranks, int to, const Order& order);

/// A rank other than 0: carries out orders until it is sent home.
class Worker {
 public:
  explicit Worker(MPI_Comm ranks) : ranks_(ranks) {}

  void run();

 private:
  void carry_out(const Order& order);
  void send_mass() const;
  void multiply() const;

  MPI_Comm ranks_;
  std::optional<PartialSystem> system_;
  std::map<int, std::unique_ptr<MumpsFactor>> factors_;
};

}  // namespace flexneck::fe_modal
