// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/python/bindings/bindings.h"
#include "pipeline/python/bindings/computing.h"
#include "pipeline/version.h"

PYBIND11_MODULE(_core, module) {
  using namespace flexneck::python;
  module.attr("__version__") = flexneck::pipeline::kVersion;
  module.attr("git_hash") = flexneck::pipeline::kGitHash;
  bind_errors(module);
  bind_mesh(module);
  bind_body(module);
  bind_run(module);
  bind_model(module);
  bind_rating(module);
  bind_commands(module);
  pybind11::module_::import("atexit").attr("register")(
      pybind11::cpp_function([] { end_solvers(); }));
}
