// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/parameter_studies/sweep/process_rank.h"

#include <array>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>
#include <unistd.h>
#include <vector>

namespace flexneck::pipeline {

namespace {

std::optional<std::uint64_t> number_in(const char* variable) {
  const char* const text = std::getenv(variable);
  std::uint64_t number = 0;
  if (text == nullptr) return {};
  const char* const end = text + std::strlen(text);
  const auto [read, error] = std::from_chars(text, end, number);
  return error == std::errc() && read == end ? std::optional(number) : std::nullopt;
}

}  // namespace

std::optional<Shard> shard_of_process() {
  // Variables of Open MPI; those of MPICH and other launchers by PMI.
  constexpr std::array<std::array<const char*, 2>, 2> kVariables = {
      {{"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE"}, {"PMI_RANK", "PMI_SIZE"}}};
  for (const auto& [rank_name, size_name] : kVariables) {
    const std::optional<std::uint64_t> rank = number_in(rank_name);
    const std::optional<std::uint64_t> size = number_in(size_name);
    if (rank && size && *size > 1 && *rank < *size) return Shard{*rank + 1, *size};
  }
  return {};
}

bool have_one_command_line() { return number_in("OMPI_NUM_APP_CTX").value_or(1) == 1; }

void forget_other_processes() {
  constexpr std::array<std::string_view, 4> kPrefixes = {"OMPI_", "PMIX_", "PMI_", "OPAL_"};
  std::vector<std::string> names;
  for (char** variable = environ; *variable != nullptr; ++variable) {
    const std::string_view text = *variable;
    for (const std::string_view prefix : kPrefixes)
      if (text.starts_with(prefix)) names.emplace_back(text.substr(0, text.find('=')));
  }
  for (const std::string& name : names) unsetenv(name.c_str());
}

}  // namespace flexneck::pipeline
