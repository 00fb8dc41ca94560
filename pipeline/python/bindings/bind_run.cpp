// SPDX-License-Identifier: GPL-3.0-or-later
#include <complex>
#include <memory>
#include <pybind11/stl.h>
#include <string>
#include <vector>

#include "pipeline/process/result_files.h"
#include "pipeline/python/bindings/arrays.h"
#include "pipeline/python/bindings/bindings.h"
#include "pipeline/python/bindings/computing.h"
#include "pipeline/results/tables/csv_output.h"

namespace flexneck::python {

namespace {

using multibody::HistoryFile;

std::shared_ptr<HistoryFile> read_run(const std::string& path) {
  std::shared_ptr<HistoryFile> run;
  compute(Place::own_thread, [&](const Checkpoint&) {
    run = std::make_shared<HistoryFile>(pipeline::read_history(path));
  });
  return run;
}

const HistoryFile& of(const py::object& self) { return self.cast<const HistoryFile&>(); }

py::array time(const py::object& self) { return rows_view(of(self).history.time_s, self); }

/// Dictionary of channel names to unit, names of the curves, filter and values (n, curves).
py::dict channels(const py::object& self) {
  py::dict all;
  for (const multibody::Channel& each : of(self).channels)
    all[py::str(each.name)] =
        py::make_tuple(each.unit, each.columns, each.filter, rows_view(each.values, self));
  return all;
}

py::dict markers(const py::object& self) {
  py::dict all;
  for (const multibody::MarkerHistory& each : of(self).history.markers) {
    py::dict motion;
    motion["position"] = rows_view(each.position_m, self);
    motion["velocity"] = rows_view(each.velocity_m_s, self);
    motion["acceleration"] = rows_view(each.acceleration_m_s2, self);
    motion["rotation"] = rows_view(each.rotation, self);
    motion["angular_velocity"] = rows_view(each.angular_velocity_rad_s, self);
    motion["angular_acceleration"] = rows_view(each.angular_acceleration_rad_s2, self);
    all[py::str(each.name)] = motion;
  }
  return all;
}

py::dict joints(const py::object& self) {
  py::dict all;
  for (const multibody::JointHistory& each : of(self).history.joints) {
    py::dict loads;
    loads["force"] = rows_view(each.force_N, self);
    loads["moment"] = rows_view(each.moment_Nm, self);
    loads["undetermined"] = each.undetermined;
    all[py::str(each.name)] = loads;
  }
  return all;
}

/// Dictionary of bodies to the names of their modes and coordinates (n, m).
py::dict modal(const py::object& self) {
  py::dict all;
  for (const multibody::ModalHistory& each : of(self).history.modal)
    all[py::str(each.body)] = py::make_tuple(each.modes, rows_view(each.coordinates, self));
  return all;
}

py::dict energy(const py::object& self) {
  const multibody::EnergyHistory& all = of(self).history.energy;
  py::dict found;
  found["kinetic"] = rows_view(all.kinetic_J, self);
  found["gravitational"] = rows_view(all.gravitational_J, self);
  found["strain"] = rows_view(all.strain_J, self);
  found["dissipated"] = rows_view(all.dissipated_J, self);
  found["work"] = rows_view(all.work_J, self);
  return found;
}

py::dict statistics(const HistoryFile& run) {
  const multibody::StepStatistics& all = run.history.statistics;
  py::dict limits;
  for (const multibody::StepLimit& limit : all.limits) limits[py::str(limit.what)] = limit.steps;
  py::dict found;
  found["accepted"] = all.accepted;
  found["rejected"] = all.rejected;
  found["evaluations"] = all.evaluations;
  found["largest_position_residual"] = all.max_position_residual;
  found["largest_velocity_residual"] = all.max_velocity_residual;
  found["limits"] = limits;
  return found;
}

/// Data of each mode of small motions: frequency, damping, growth and the complex amplitudes of the
/// markers (markers, 3), copied.
py::object linearisation(const HistoryFile& run) {
  if (!run.linearisation) return py::none();
  const auto rows = [](const Eigen::Matrix3Xcd& columns) {
    py::array_t<std::complex<double>> array({columns.cols(), Eigen::Index(3)});
    std::copy(columns.data(), columns.data() + columns.size(), array.mutable_data());
    return array;
  };
  py::list modes;
  for (const multibody::ModeShape& each : run.linearisation->modes)
    modes.append(py::make_tuple(each.mode.frequency_Hz, each.mode.damped_frequency_Hz,
                                each.mode.damping_ratio, each.mode.growth_rate_1_s, each.mode.kink,
                                rows(each.translation), rows(each.rotation)));
  return py::make_tuple(run.linearisation->about, run.linearisation->markers, modes);
}

py::list parameters(const HistoryFile& run) {
  py::list all;
  for (const Parameter& each : run.provenance.parameters)
    all.append(py::make_tuple(each.key, each.value, std::string(name_of(each.origin)), each.note));
  return all;
}

void write(const std::shared_ptr<HistoryFile>& run, const std::string& path) {
  compute(Place::own_thread, [&](const Checkpoint&) { multibody::write_history(path, *run); });
}

void write_table(const std::shared_ptr<HistoryFile>& run, const std::string& path) {
  compute(Place::own_thread, [&](const Checkpoint&) {
    pipeline::write_csv(path, run->history.time_s, run->channels);
  });
}

}  // namespace

void bind_run(py::module_& module) {
  py::class_<HistoryFile, std::shared_ptr<HistoryFile>>(module, "RunData")
      .def_property_readonly("time", time)
      .def_property_readonly("channels", channels)
      .def_property_readonly("markers", markers)
      .def_property_readonly("joints", joints)
      .def_property_readonly("modal", modal)
      .def_property_readonly("energy", energy)
      .def_property_readonly("statistics", statistics)
      .def_property_readonly("linearisation", linearisation)
      .def_property_readonly("parameters", parameters)
      .def_property_readonly("incomplete",
                             [](const HistoryFile& run) { return run.history.incomplete; })
      .def_property_readonly("warnings",
                             [](const HistoryFile& run) { return run.history.warnings; })
      .def("write", write, py::arg("path"))
      .def("write_table", write_table, py::arg("path"));
  module.def("read_run", read_run, py::arg("path"));
}

}  // namespace flexneck::python
