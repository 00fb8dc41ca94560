// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/stl.h>
#include <string>
#include <tuple>
#include <vector>

#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "pipeline/cli/execute.h"
#include "pipeline/exchange/export_formats.h"
#include "pipeline/experiments/verification/verification.h"
#include "pipeline/language/document/key_reference.h"
#include "pipeline/language/document/shipped_files.h"
#include "pipeline/language/model/model_file.h"
#include "pipeline/parameter_studies/sampling/interrupt.h"
#include "pipeline/process/result_table.h"
#include "pipeline/python/bindings/bindings.h"
#include "pipeline/python/bindings/computing.h"

namespace flexneck::python {

namespace py = pybind11;
using namespace pipeline;

namespace {

/// True for sweeps and fits, which handle Ctrl-C themselves and keep finished rows.
bool looks_after_signals(const Command& command) {
  return command.name == "sweep" || command.name == "fit";
}

struct Request {
  std::string command;
  std::vector<std::string> files, settings;
  std::string folder, target;
  int threads = 0;
  bool redo = false, sensitivity = false;
};

CommandLine line_of(const Request& request) {
  CommandLine line;
  line.command = &commands()[find_name(names_of(commands()), request.command, "command")];
  line.text = "flexneck " + request.command + " (Python)";
  line.files = request.files;
  line.settings = request.settings;
  line.folder = request.folder;
  line.target = request.target;
  line.redo = request.redo;
  line.sensitivity = request.sensitivity;
  line.shares.threads = request.threads;
  return line;
}

/// Runs a command as the command line does. @return true if it passed, and its warnings
std::pair<bool, std::vector<std::string>> run(const Request& request) {
  const CommandLine line = line_of(request);
  bool passed = false;
  std::vector<std::string> warnings;
  bool is_stopped = false;
  compute(Place::solver_thread, [&](const Checkpoint& checkpoint) {
    start_solvers();
    Messages messages(checkpoint);
    try {
      passed = execute(line, messages.console());
    } catch (const ComputationError& error) {
      if (!looks_after_signals(*line.command) || !Interrupt::is_asked()) throw;
      is_stopped = true;
      messages.warn(error.what());
    }
    warnings = messages.warnings();
  });
  if (is_stopped) {
    PyErr_SetString(PyExc_KeyboardInterrupt, warnings.back().c_str());
    throw py::error_already_set();
  }
  return {passed, warnings};
}

/// Returns whether a format of `export` is for a study's mesh and modes; otherwise it is for a
/// file. Unknown extensions are reported by the command.
bool exports_study(const std::string& ending) {
  for (const ExportFormat& format : export_formats())
    if (format.ending == ending) return format.write != nullptr;
  return true;
}

py::list values(const std::vector<Parameter>& parameters) {
  py::list all;
  for (const Parameter& each : parameters)
    all.append(py::make_tuple(each.key, each.value, std::string(name_of(each.origin)), each.note));
  return all;
}

py::dict study(const std::string& path, const std::vector<std::string>& settings) {
  Study read;
  compute(Place::own_thread, [&](const Checkpoint&) { read = read_study(path, settings); });
  py::list cases;
  for (const CaseSection& each : read.cases)
    cases.append(py::make_tuple(each.name,
                                each.kind == CaseSection::Kind::pendulum ? "pendulum" : "static"));
  py::dict found;
  found["file"] = read.file.string();
  found["cases"] = cases;
  found["tests"] = names_of(read.tests);
  found["values"] = values(read.parameters);
  found["defaults"] = values(read.defaults);
  return found;
}

py::list tables(const std::string& path) {
  py::list all;
  for (const ResultTable& table : read_tables(path).tables) {
    py::list columns;
    for (const ResultTable::Column& column : table.columns)
      columns.append(py::make_tuple(column.name, column.unit));
    all.append(py::make_tuple(table.name, table.title, columns, table.rows, table.notes));
  }
  return all;
}

py::list verification(const std::string& path) {
  py::list all;
  for (const VerificationRow& row : read_verification(path).table.rows) {
    constexpr std::array<const char*, 4> kStatus = {"passed", "failed", "compared", "unjudged"};
    all.append(py::make_tuple(row.quantity, row.detail, row.value, row.reference, row.unit,
                              row.error_percent, kStatus.at(static_cast<std::size_t>(row.status)),
                              row.fitted));
  }
  return all;
}

}  // namespace

void bind_commands(py::module_& module) {
  module.def(
      "execute",
      [](const std::string& command, const std::vector<std::string>& files,
         const std::vector<std::string>& settings, const std::string& folder,
         const std::string& target, int threads, bool redo, bool sensitivity) {
        return run({command, files, settings, folder, target, threads, redo, sensitivity});
      },
      py::arg("command"), py::arg("files"), py::arg("settings"), py::arg("folder"),
      py::arg("target") = "", py::arg("threads") = 0, py::arg("redo") = false,
      py::arg("sensitivity") = false);
  module.def("exports_study", exports_study, py::arg("ending"));
  module.def("study", study, py::arg("path"), py::arg("settings"));
  module.def("tables", tables, py::arg("path"));
  module.def(
      "holds_tables", [](const std::string& path) { return holds_tables(path); }, py::arg("path"));
  module.def("verification", verification, py::arg("path"));
  module.def(
      "named_file", [](const std::string& name) { return named_file(name).string(); },
      py::arg("name"));
  module.def("shipped_names", shipped_names);
}

}  // namespace flexneck::python
