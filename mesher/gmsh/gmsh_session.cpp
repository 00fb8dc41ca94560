// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/gmsh/gmsh_session.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <new>
#include <string_view>
#include <vector>

#include <gmsh.h>

#include "geometry/foundation/error.h"

namespace flexneck::mesher {
namespace {

/// gmsh has one state per process, and its API 4.8 cannot tell whether it is initialised.
std::atomic_flag gmsh_in_use;

void add_unique(std::vector<std::string>& errors, std::string error) {
  while (!error.empty() && (error.back() == '\n' || error.back() == ' ')) error.pop_back();
  if (!error.empty() && std::find(errors.begin(), errors.end(), error) == errors.end()) {
    errors.push_back(std::move(error));
  }
}

/// The logged lines of this kind, each once, without their prefix.
std::vector<std::string> logged(std::string_view prefix) {
  std::vector<std::string> log;
  gmsh::logger::get(log);
  std::vector<std::string> found;
  for (const std::string& line : log) {
    if (line.starts_with(prefix)) add_unique(found, line.substr(prefix.size()));
  }
  return found;
}

bool is_failure(const std::string& warning) { return warning.find("failed") != std::string::npos; }

/// True for gmsh's error message after a failed allocation.
bool is_want_of_memory(const std::string& error) { return error.starts_with("Out of memory"); }

}  // namespace

GmshSession::GmshSession() {
  if (gmsh_in_use.test_and_set()) {
    throw ComputationError("only one gmsh session can be open at a time, and another one is open");
  }
  gmsh::initialize(0, nullptr, /*readConfigFiles=*/false);
  gmsh::option::setNumber("General.Terminal", 0);
  // The constants of earlier scripts outlive gmsh::finalize() and would override new ones.
  gmsh::onelab::clear();
}

GmshSession::~GmshSession() {
  try {
    gmsh::finalize();
  } catch (...) {
    // A destructor must not throw, and nothing is left to save.
  }
  gmsh_in_use.clear();
}

std::string GmshSession::errors_of(const std::function<void()>& action) {
  std::string thrown;
  gmsh::logger::start();
  try {
    action();
  } catch (const std::bad_alloc&) {
    gmsh::logger::stop();
    throw;
  } catch (const std::exception& error) {
    thrown = error.what();
  } catch (const std::string& error) {  // gmsh up to 4.8 throws its messages as strings …
    thrown = error;
  } catch (int code) {  // … or as numbers
    thrown = "gmsh error " + std::to_string(code);
  }
  std::vector<std::string> errors = logged("Error: ");
  failures_ = logged("Warning: ");
  std::erase_if(failures_, [](const std::string& warning) { return !is_failure(warning); });
  gmsh::logger::stop();
  if (std::any_of(errors.begin(), errors.end(), is_want_of_memory)) throw std::bad_alloc();
  if (errors.empty()) add_unique(errors, thrown);

  std::string joined;
  for (const std::string& error : errors) joined += (joined.empty() ? "" : "; ") + error;
  return joined;
}

}  // namespace flexneck::mesher
