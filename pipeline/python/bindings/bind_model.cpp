// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>
#include <optional>
#include <pybind11/functional.h>
#include <pybind11/stl.h>
#include <string>
#include <utility>
#include <vector>

#include "geometry/foundation/names.h"
#include "pipeline/cli/simulated_model.h"
#include "pipeline/exchange/fmu_export.h"
#include "pipeline/language/document/shipped_files.h"
#include "pipeline/python/bindings/arrays.h"
#include "pipeline/python/bindings/bindings.h"
#include "pipeline/python/bindings/computing.h"
#include "pipeline/run/folder_lock.h"

namespace flexneck::python {

namespace {

using pipeline::ModelFile;

/// A model, shared by the copies of its runs.
class Model {
 public:
  Model(const std::string& path, const std::optional<std::string>& text,
        const std::vector<std::string>& settings) {
    compute(Place::own_thread, [&](const Checkpoint&) {
      file_ = text ? pipeline::read_model_file({path, *text}, settings)
                   : pipeline::read_model_file(path, settings);
    });
  }

  std::string file() const { return file_.file.string(); }
  std::vector<std::string> warnings() const { return file_.warnings; }
  py::list parameters() const {
    py::list all;
    for (const Parameter& each : file_.parameters)
      all.append(
          py::make_tuple(each.key, each.value, std::string(name_of(each.origin)), each.note));
    return all;
  }

  /// @param function  takes time, position (3), velocity (3), rotation (3, 3) and angular velocity
  /// (3); gives force (3) and moment (3)
  void add_function(const std::string& name, const std::string& lower, const std::string& upper,
                    py::function function);

  std::pair<std::shared_ptr<multibody::HistoryFile>, std::string> simulate() const {
    pipeline::SimulatedModel done;
    compute(Place::own_thread, [&](const Checkpoint& checkpoint) {
      ModelFile file = file_;
      file.solver.checkpoint = checkpoint;
      done = pipeline::simulated(file);
    });
    return {std::make_shared<multibody::HistoryFile>(std::move(done.results)), done.problem};
  }

  /// Simulates into files.
  /// @return warnings
  std::vector<std::string> simulate_into(const std::string& folder) const {
    std::vector<std::string> warnings;
    compute(Place::own_thread, [&](const Checkpoint& checkpoint) {
      ModelFile file = file_;
      file.solver.checkpoint = checkpoint;
      Messages messages(checkpoint);
      const pipeline::Console console = messages.console();
      const pipeline::FolderLock lock(folder, "flexneck simulate (Python)",
                                      [&](const std::string& line) { messages.warn(line); });
      const pipeline::ResultsFolder results{folder};
      pipeline::simulate_model(
          file, {.files = {}, .settings = {}, .folder = results, .console = console});
      warnings = messages.warnings();
    });
    return warnings;
  }

  /// Exports an FMU.
  /// @return warnings
  std::vector<std::string> export_fmu(const std::string& path) const {
    std::vector<std::string> warnings;
    compute(Place::own_thread, [&](const Checkpoint& checkpoint) {
      Messages messages(checkpoint);
      pipeline::write_fmu(file_, path, messages.console());
      warnings = messages.warnings();
    });
    return warnings;
  }

 private:
  ModelFile file_;
};

py::array_t<double> numbers(const Eigen::Vector3d& vector) {
  return py::array_t<double>(3, vector.data());
}

Eigen::Vector3d vector_of(const std::string& who, const py::handle& value) {
  try {
    const auto numbers =
        py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(value);
    if (numbers && numbers.size() == 3)
      return {numbers.data()[0], numbers.data()[1], numbers.data()[2]};
  } catch (const py::error_already_set&) {
    PyErr_Clear();
  }
  PyErr_Clear();
  throw InputError(who + ": expected three numbers of a force and three of a moment, found " +
                   std::string(py::str(value)));
}

/// Python function that is called with the global lock, and released by a thread that may not hold
/// it.
struct HeldFunction {
  explicit HeldFunction(py::function function) : call(std::move(function)) {}
  ~HeldFunction() {
    const py::gil_scoped_acquire lock;
    call.release().dec_ref();
  }
  HeldFunction(const HeldFunction&) = delete;
  HeldFunction& operator=(const HeldFunction&) = delete;

  py::function call;
};

void Model::add_function(const std::string& name, const std::string& lower,
                         const std::string& upper, py::function function) {
  multibody::FunctionForce force;
  force.name = name;
  force.marker_i = file_.model.marker_index(lower);
  force.marker_j = file_.model.marker_index(upper);
  const std::string who = std::string(multibody::FunctionForce::kName) + " '" + name + "'";
  force.load = [who, held = std::make_shared<HeldFunction>(std::move(function))](
                   double time_s, const multibody::RelativeMotion& motion) {
    const py::gil_scoped_acquire lock;
    const py::object found =
        held->call(time_s, numbers(motion.position_m), numbers(motion.velocity_m_s),
                   copied(motion.rotation), numbers(motion.angular_velocity_rad_s));
    if (!py::isinstance<py::tuple>(found) || py::len(found) != 2)
      throw InputError(who + ": expected a force and a moment, found " +
                       std::string(py::str(found)));
    const auto pair = py::reinterpret_borrow<py::tuple>(found);
    return multibody::FunctionLoad{vector_of(who, pair[0]), vector_of(who, pair[1])};
  };
  file_.model.forces.add(std::move(force));
  multibody::check(file_.model);
  file_.parameters.push_back({std::string(multibody::FunctionForce::kName) + "." + name,
                              "a function of Python", Origin::synthetic,
                              "not stored in any file; ask the author of this run"});
}

}  // namespace

void bind_model(py::module_& module) {
  py::class_<Model, std::shared_ptr<Model>>(module, "ModelData")
      .def(py::init<const std::string&, const std::optional<std::string>&,
                    const std::vector<std::string>&>(),
           py::arg("path"), py::arg("text"), py::arg("settings"))
      .def_property_readonly("file", &Model::file)
      .def_property_readonly("warnings", &Model::warnings)
      .def_property_readonly("parameters", &Model::parameters)
      .def("add_function", &Model::add_function, py::arg("name"), py::arg("lower"),
           py::arg("upper"), py::arg("function"))
      .def("export_fmu", &Model::export_fmu, py::arg("path"))
      .def("simulate", &Model::simulate)
      .def("simulate_into", &Model::simulate_into, py::arg("folder"));
}

}  // namespace flexneck::python
