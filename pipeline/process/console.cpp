// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/process/console.h"

#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <iostream>
#include <utility>

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include "geometry/foundation/error.h"
#include "geometry/foundation/printable.h"

namespace flexneck::pipeline {

namespace {

/// Shortens a line in the middle, since names in a user's file may be very long.
std::string shortened(std::string line) {
  constexpr std::size_t kLongest = 4000;
  constexpr std::size_t kKept = kLongest / 2;
  if (line.size() <= kLongest) return line;
  const auto is_inside_character = [&](std::size_t place) {
    return (static_cast<std::uint8_t>(line[place]) & 0xC0U) == 0x80;
  };
  std::size_t begin = kKept;
  std::size_t end = line.size() - kKept;
  while (is_inside_character(begin)) --begin;
  while (is_inside_character(end)) --end;
  return line.replace(begin, end - begin, " […] ");
}

std::string one_line(const std::string& text) { return shortened(printable(text)); }

}  // namespace

void prepare_process() {
  for (int stream = 0; stream <= 2; ++stream) {
    if (::fcntl(stream, F_GETFD) >= 0) continue;
    // open() takes the lowest free descriptor.
    ::open("/dev/null", stream == 0 ? O_WRONLY : O_RDONLY);
  }
  std::signal(SIGXFSZ, SIG_IGN);
}

void require_written_output() {
  std::cout.flush();
  if (std::cout && std::ferror(stdout) == 0 && std::fflush(stdout) == 0) return;
  throw ComputationError(std::string("standard output: cannot be written (") +
                         std::strerror(errno) + ")");
}

Console::Console(Verbosity verbosity) : verbosity_(verbosity) {
  auto logger = spdlog::stderr_color_mt("flexneck");
  logger->set_pattern(verbosity == Verbosity::verbose ? "%^[%T.%e]%$ %v" : "%v");
  logger->set_level(verbosity == Verbosity::none      ? spdlog::level::off
                    : verbosity == Verbosity::quiet   ? spdlog::level::err
                    : verbosity == Verbosity::verbose ? spdlog::level::debug
                                                      : spdlog::level::info);
  spdlog::set_default_logger(std::move(logger));
}

Console::Console(Receiver receiver, std::function<void()> checkpoint)
    : verbosity_(Verbosity::normal),
      receiver_(std::move(receiver)),
      checkpoint_(std::move(checkpoint)) {}

/// Passes a message to the receiver. @return true if there is a receiver
bool Console::hand_on(Message kind, const std::string& text) const {
  if (receiver_) receiver_(kind, text);
  return receiver_ != nullptr;
}

void Console::result(const std::string& text) const {
  if (hand_on(Message::result, text)) return;
  if (verbosity_ <= Verbosity::quiet) return;
  std::cout << printable(text, "\n") << '\n';
  require_written_output();
}

void Console::table(const std::string& text) const {
  if (is_verbose()) result(text);
}

void Console::step(const std::string& line) const {
  if (!hand_on(Message::step, line)) spdlog::info(one_line(line));
}

Console Console::with_listener(Progress on_warning) const {
  Console console = *this;
  console.on_warning_ = std::move(on_warning);
  return console;
}

void Console::warning(const std::string& line) const {
  if (on_warning_) on_warning_(line);
  if (!hand_on(Message::warning, line)) spdlog::error("Warning: {}", one_line(line));
}

void Console::error(const std::string& line) const {
  if (!hand_on(Message::error, line)) spdlog::error("flexneck: {}", one_line(line));
}

Progress Console::detail() const {
  return [console = *this](const std::string& line) {
    if (!console.hand_on(Message::detail, line)) spdlog::debug("  {}", one_line(line));
  };
}

Progress Console::warnings(const std::string& of) const {
  return [console = *this, of](const std::string& line) { console.warning(of + ": " + line); };
}

}  // namespace flexneck::pipeline
