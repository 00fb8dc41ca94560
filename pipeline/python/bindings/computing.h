// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "pipeline/process/console.h"

namespace flexneck::python {

/// Function that throws once the user has asked to stop.
using Checkpoint = std::function<void()>;

/// Thread for some work: gmsh, PETSc and MPI need the single thread that the process reserves for
/// them, one piece of work after another; other work gets a thread of its own.
enum class Place { own_thread, solver_thread };

/// Runs work without Python's global lock while the caller waits and checks for signals: Ctrl-C
/// makes the checkpoint throw and is raised as KeyboardInterrupt.
/// @pre the caller holds Python's global lock
/// @throws what the work throws
void compute(Place place, const std::function<void(const Checkpoint& checkpoint)>& work);

/// Starts PETSc and MPI unless they have been started. To be called on the thread of the solvers.
/// @throws InputError in one of several processes of mpirun.
void start_solvers();
/// Ends PETSc and MPI at the end of the interpreter.
void end_solvers();

/// Messages of a computation: warnings are kept for Python, all other messages are checkpoints.
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
