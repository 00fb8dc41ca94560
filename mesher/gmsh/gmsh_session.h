// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace flexneck::mesher {

/// gmsh keeps one model database per process; a session owns it from construction to destruction.
/// It prints nothing and reads no configuration files of the user.
class GmshSession {
 public:
  /// @throws ComputationError if another session is alive.
  GmshSession();
  ~GmshSession();
  GmshSession(const GmshSession&) = delete;
  GmshSession& operator=(const GmshSession&) = delete;

  /// Runs `action` and collects the errors that gmsh reports meanwhile, whether it throws or only
  /// logs them. Returns them joined by "; ", empty if there were none. Exceptions for lack of
  /// memory pass.
  std::string errors_of(const std::function<void()>& action);

  /// Failures in the last action after which gmsh went on: the mesh may differ from the one asked
  /// for.
  const std::vector<std::string>& failures() const { return failures_; }

 private:
  std::vector<std::string> failures_;
};

}  // namespace flexneck::mesher
