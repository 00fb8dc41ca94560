// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <catch2/catch.hpp>

#include "fe_modal/body/modal_body_file.h"
#include "mesher/mesh/mesh_file.h"
#include "mesher/mesh/mesh_summary.h"
#include "tests/support/flexneck_command.h"

namespace flexneck::testing {

inline const std::string kExamples = std::string(FLEXNECK_SOURCE_DIR) + "/geometry/examples/";

/// Runs a study into `folder`; any failure fails the test with the printed text.
inline void run_study(const std::string& study, const std::filesystem::path& folder,
                      const std::string& more = "") {
  const CommandOutcome outcome = run_flexneck("run " + study + " -o " + folder.string() + more);
  INFO(outcome.text);
  REQUIRE(outcome.exit_code == 0);
}

inline Eigen::VectorXd frequencies_in(const std::filesystem::path& folder) {
  return fe_modal::read_modal_body(folder / "modes.h5").body.frequencies_Hz;
}

inline mesher::MeshSummary summary_of(const std::filesystem::path& folder) {
  return mesher::summarise(mesher::read_mesh(folder / "mesh.h5").mesh);
}

/// Largest relative error.
inline double largest_error(const Eigen::VectorXd& computed, const std::vector<double>& truth) {
  REQUIRE(computed.size() <= static_cast<Eigen::Index>(truth.size()));
  double largest = 0;
  for (Eigen::Index k = 0; k < computed.size(); ++k) {
    const double expected = truth[static_cast<std::size_t>(k)];
    largest = std::max(largest, std::abs(computed[k] - expected) / expected);
  }
  return largest;
}

}  // namespace flexneck::testing
