// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/console.h"

#include <cstdio>

#include <fmt/core.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

namespace flexneck::pipeline {

Console::Console(Verbosity verbosity) : verbosity_(verbosity) {
  auto logger = spdlog::stderr_color_mt("flexneck");
  logger->set_pattern(verbosity == Verbosity::verbose ? "%^[%T.%e]%$ %v" : "%v");
  logger->set_level(verbosity == Verbosity::quiet     ? spdlog::level::err
                    : verbosity == Verbosity::verbose ? spdlog::level::debug
                                                      : spdlog::level::info);
  spdlog::set_default_logger(std::move(logger));
}

void Console::result(const std::string& text) const {
  if (verbosity_ == Verbosity::quiet) return;
  fmt::print("{}\n", text);
  std::fflush(stdout);
}

void Console::step(const std::string& line) const { spdlog::info(line); }

void Console::warning(const std::string& line) const { spdlog::error("Warning: {}", line); }

void Console::error(const std::string& line) const { spdlog::error("flexneck: {}", line); }

Progress Console::detail() const {
  return [](const std::string& line) { spdlog::debug("  {}", line); };
}

}  // namespace flexneck::pipeline
