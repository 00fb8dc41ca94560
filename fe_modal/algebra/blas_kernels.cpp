// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/algebra/blas_kernels.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <dlfcn.h>
#include <string_view>

namespace flexneck::fe_modal {
namespace {

constexpr const char* kVariable = "OPENBLAS_CORETYPE";
/// What OpenBLAS takes for a model of Intel's or AMD's that it does not know.
constexpr std::array<std::string_view, 2> kFallbacks = {"Prescott", "Barcelona"};

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

/// What OpenBLAS calls kernels that the processor can run; empty where it can run old ones only.
const char* kernels_for_this_processor() {
#ifdef __x86_64__
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
      __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq")) {
    return "SkylakeX";
  }
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return "Haswell";
#endif
  return "";
}

}  // namespace

void choose_blas_kernels() {
  const std::string better = kernels_for_this_processor();
  const bool is_known =
      std::find(kFallbacks.begin(), kFallbacks.end(), chosen_kernels()) == kFallbacks.end();
  if (is_known || better.empty() || std::getenv(kVariable) != nullptr) return;
  const auto quit = find<void()>("gotoblas_dynamic_quit");
  const auto init = find<void()>("gotoblas_dynamic_init");
  if (quit == nullptr || init == nullptr) return;
  constexpr int kOverwrite = 1;
  setenv(kVariable, better.c_str(), kOverwrite);
  quit();
  init();
  unsetenv(kVariable);
}

unsigned threads_in_blas(unsigned threads) { return kind_of_threads() == 0 ? 1 : threads; }

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
