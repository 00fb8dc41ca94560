// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/algebra/blas_library.h"

#include <dlfcn.h>

namespace flexneck::fe_modal {
namespace {

/// A function that is there if the BLAS is OpenBLAS, otherwise null.
template <typename Function>
Function* find(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_DEFAULT, name));
}

std::string chosen_kernels() {
  const auto name = find<char*()>("openblas_get_corename");
  return name == nullptr ? "" : name();
}

/// Of OpenBLAS: none, its own or OpenMP's; none of another BLAS.
int kind_of_threads() {
  const auto kind = find<int()>("openblas_get_parallel");
  return kind == nullptr ? 0 : kind();
}

}  // namespace

void call_blas_alone() {
  constexpr int kOwnThreads = 1;
  const bool is_of_process = kind_of_threads() == kOwnThreads;
  if (const auto set_number =
          find<void(int)>(is_of_process ? "openblas_set_num_threads" : "omp_set_num_threads")) {
    set_number(1);
  }
}

std::string blas_version() {
  const auto configuration = find<char*()>("openblas_get_config");
  if (configuration == nullptr) return "unknown";
  const std::string text = configuration();  // "OpenBLAS 0.3.21 NO_LAPACKE ..."
  const std::size_t end = text.find(' ', text.find(' ') + 1);
  return text.substr(0, end) + ", " + chosen_kernels();
}

}  // namespace flexneck::fe_modal
