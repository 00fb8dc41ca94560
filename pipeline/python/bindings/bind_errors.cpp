// SPDX-License-Identifier: GPL-3.0-or-later
#include <exception>
#include <filesystem>
#include <new>
#include <utility>

#include "geometry/foundation/error.h"
#include "geometry/foundation/path_error.h"
#include "pipeline/python/bindings/bindings.h"

namespace flexneck::python {

namespace py = pybind11;

namespace {

/// Raises an exception of the package's own classes (flexneck/errors.py).
void raise(const char* name, const char* text) {
  const py::object type = py::module_::import("flexneck.errors").attr(name);
  PyErr_SetString(type.ptr(), text);
}

}  // namespace

void bind_errors(py::module_& /*module*/) {
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(std::move(thrown));
    } catch (const InputError& error) {
      raise("InputError", error.what());
    } catch (const ComputationError& error) {
      raise("ComputationError", error.what());
    } catch (const std::filesystem::filesystem_error& error) {
      raise(is_of_path(error) ? "InputError" : "ComputationError", text_of(error).c_str());
    } catch (const py::error_already_set&) {
      throw;  // exceptions of pybind11, and lack of memory as Python's own exception
    } catch (const py::builtin_exception&) {
      throw;
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      raise("ComputationError", error.what());
    }
  });
}

}  // namespace flexneck::python
