// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "pipeline/console/console.h"

namespace flexneck::python {

/// Throws, once the user has asked to stop.
using Checkpoint = std::function<void()>;

/// Where work is done: what gmsh, PETSc and MPI take part in on one thread that the process has for
/// them, one piece of work after another; any other on a thread of its own.
enum class Place { own_thread, solver_thread };

/// Does work without Python's global lock while the caller waits and looks after signals: Ctrl-C
/// lets the checkpoint throw and comes back as KeyboardInterrupt.
/// @pre the caller holds the lock
/// @throws what the work throws
void compute(Place place, const std::function<void(const Checkpoint& checkpoint)>& work);

/// Starts PETSc and MPI if that has not been done yet. To be called on the thread of the solvers.
/// @throws InputError in one of several processes of mpirun.
void start_solvers();
/// Ends PETSc and MPI at the end of the interpreter.
void end_solvers();

/// What a computation tells: warnings are kept for Python, all else is a checkpoint.
class Messages {
 public:
  explicit Messages(Checkpoint checkpoint);
  pipeline::Console console();
  void warn(const std::string& line) { warnings_.push_back(line); }
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  Checkpoint checkpoint_;
  std::vector<std::string> warnings_;
};

}  // namespace flexneck::python
