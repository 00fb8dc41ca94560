// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/python/bindings/computing.h"

#include <atomic>
#include <chrono>
#include <future>
#include <memory>
#include <optional>
#include <pybind11/pybind11.h>
#include <thread>
#include <utility>

#include "fe_modal/algebra/petsc_session.h"
#include "fe_modal/algebra/rank_session.h"
#include "geometry/foundation/error.h"
#include "pipeline/parameter_studies/evaluation/serial_thread.h"
#include "pipeline/parameter_studies/sampling/interrupt.h"

namespace flexneck::python {

namespace py = pybind11;

namespace {

constexpr std::chrono::milliseconds kLook(50);  ///< interval of checks for signals

/// Thrown by a checkpoint; only compute() catches it.
struct Stopped {};

/// Solvers of the process, as MPI is per process: started at first use, ended by end_solvers().
struct Solvers {
  std::optional<fe_modal::PetscSession> session;
  pipeline::SerialThread thread;  ///< declared last: its work uses the session
};

std::unique_ptr<Solvers>& solvers() {
  static std::unique_ptr<Solvers> kept;
  return kept;
}

void do_work(Place place, const std::function<void()>& work) {
  if (place == Place::own_thread) return work();
  solvers()->thread.run(work);
}

/// Waits while checking for signals. @return the exception raised by a signal's handler
std::optional<py::error_already_set> wait_for(const std::future<void>& done,
                                              std::atomic<bool>& stop) {
  std::optional<py::error_already_set> raised;
  while (done.wait_for(kLook) != std::future_status::ready) {
    const py::gil_scoped_acquire lock;
    if (PyErr_CheckSignals() == 0) continue;
    if (raised) {
      PyErr_Clear();
    } else {
      raised.emplace();
    }
    stop = true;
  }
  return raised;
}

}  // namespace

void compute(Place place, const std::function<void(const Checkpoint&)>& work) {
  if (place == Place::solver_thread && !solvers()) solvers() = std::make_unique<Solvers>();
  std::atomic<bool> stop = false;
  const Checkpoint checkpoint = [&stop] {
    if (stop) throw Stopped();
  };
  std::optional<py::error_already_set> raised;
  {
    const py::gil_scoped_release unlocked;
    std::packaged_task<void()> task([&] {
      do_work(place, [&] {
        // The thread stays known to Python, which makes calls of its functions cheap.
        const py::gil_scoped_acquire known;
        const py::gil_scoped_release free;
        work(checkpoint);
      });
    });
    std::future<void> done = task.get_future();
    std::thread thread(std::move(task));
    raised = wait_for(done, stop);
    thread.join();
    try {
      done.get();
    } catch (const Stopped&) {
      if (!raised) throw;
    } catch (...) {
      if (!raised) throw;  // the handler's exception is more specific than the resulting one
    }
  }
  if (raised) throw std::move(*raised);
}

void start_solvers() {
  if (fe_modal::RankSession::is_launched())
    throw InputError(
        "flexneck for Python runs on one process only, but mpirun has started several; use 'mpirun "
        "flexneck modes', whose folder of results can be read from Python");
  if (!solvers()->session) solvers()->session.emplace();
}

void end_solvers() {
  if (!solvers()) return;
  const py::gil_scoped_release unlocked;
  // The session ends on the thread that started it.
  solvers()->thread.run([] { solvers()->session.reset(); });
  solvers().reset();
}

Messages::Messages(Checkpoint checkpoint) : checkpoint_(std::move(checkpoint)) {}

pipeline::Console Messages::console() {
  const auto receive = [this](pipeline::Message kind, const std::string& text) {
    if (kind == pipeline::Message::warning) warn(text);
    checkpoint_();
  };
  return {receive, checkpoint_};
}

}  // namespace flexneck::python
