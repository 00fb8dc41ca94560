// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/algebra/blas_library.h"

#include <dlfcn.h>

namespace flexneck::fe_modal {
namespace {

/// Finds a function of the BLAS by its name; null if the BLAS is not OpenBLAS.
template <typename Function>
Function* find(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_DEFAULT, name));
}

std::string chosen_kernels() {
  const auto name = find<char*()>("openblas_get_corename");
  return name == nullptr ? "" : name();
}

}  // namespace

void call_blas_alone() {
  for (const char* set_number : {"openblas_set_num_threads", "omp_set_num_threads"})
    if (const auto set = find<void(int)>(set_number)) set(1);
  // CHOLMOD asks for four threads wherever it asks for any, whatever the number of processors: with
  // zero levels of OpenMP allowed to be active it gets one.
  if (const auto set_levels = find<void(int)>("omp_set_max_active_levels")) set_levels(0);
}

std::string blas_version() {
  const auto configuration = find<char*()>("openblas_get_config");
  if (configuration == nullptr) return "unknown";
  const std::string text = configuration();  // "OpenBLAS 0.3.21 NO_LAPACKE ..."
  const std::size_t end = text.find(' ', text.find(' ') + 1);
  return text.substr(0, end) + ", " + chosen_kernels();
}

}  // namespace flexneck::fe_modal
