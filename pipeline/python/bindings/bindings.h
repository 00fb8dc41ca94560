// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

namespace flexneck::python {

// Bindings of each stage to the module, one function and file for each. Users see the package
// beside it (flexneck/*.py).

void bind_errors(pybind11::module_& module);
void bind_commands(pybind11::module_& module);  ///< studies, commands, tables of results
void bind_mesh(pybind11::module_& module);
void bind_body(pybind11::module_& module);
void bind_run(pybind11::module_& module);
void bind_model(pybind11::module_& module);
void bind_rating(pybind11::module_& module);

}  // namespace flexneck::python
