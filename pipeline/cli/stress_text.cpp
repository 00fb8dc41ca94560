// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/cli/stress_text.h"

#include <vector>

#include <fmt/core.h>

#include "pipeline/process/text_table.h"

namespace flexneck::pipeline {

namespace {

using Eigen::Index;

std::string text_of(const Eigen::Vector3d& v) {
  return fmt::format("({:.4g}, {:.4g}, {:.4g})", v[0], v[1], v[2]);
}

std::vector<std::string> resultant_row(const std::string& name,
                                       const fe_modal::StaticSolution& solution,
                                       const Eigen::Matrix3Xd& forces_N) {
  const fe_modal::Resultant sum = fe_modal::resultant_of(solution.nodes_m, forces_N);
  return {name, text_of(sum.force_N), text_of(sum.moment_Nm)};
}

std::vector<std::string> stress_row(const fe_modal::StaticSolution& solution,
                                    const fe_modal::NodalStresses& stresses) {
  Index worst = 0;
  double largest_Pa = -1;
  for (Index k = 0; k < stresses.stress_Pa.cols(); ++k) {
    const double here_Pa = fe_modal::von_mises_Pa(stresses.stress_Pa.col(k));
    if (here_Pa <= largest_Pa) continue;
    largest_Pa = here_Pa;
    worst = k;
  }
  std::vector<std::string> row = {
      stresses.material, fmt::format("{:.4g}", largest_Pa),
      text_of(solution.nodes_m.col(stresses.nodes[static_cast<std::size_t>(worst)]))};
  for (Index c = 0; c < 6; ++c) row.push_back(fmt::format("{:.4g}", stresses.stress_Pa(c, worst)));
  return row;
}

}  // namespace

std::string stress_text(const fe_modal::StaticSolution& solution) {
  std::string text;
  for (const std::string& load : solution.loads) text += "  " + load + "\n";
  std::vector<std::vector<std::string>> sums = {
      {"resultant", "force, N", "moment about the origin, N m"}};
  sums.push_back(resultant_row("loads", solution, solution.applied_N));
  sums.push_back(resultant_row("reactions", solution, solution.reactions_N));
  text += text_table(sums, {0, 1, 2});
  Index farthest = 0;
  const double most_m = solution.displacements_m.colwise().norm().maxCoeff(&farthest);
  text += fmt::format("\nLargest displacement {:.4g} m, {}, at {} m\n", most_m,
                      text_of(solution.displacements_m.col(farthest)),
                      text_of(solution.nodes_m.col(farthest)));
  std::vector<std::vector<std::string>> rows = {
      {"material", "von Mises, Pa", "at, m", "xx", "yy", "zz", "xy", "xz", "yz"}};
  for (const fe_modal::NodalStresses& each : solution.at_nodes)
    rows.push_back(stress_row(solution, each));
  return text + text_table(rows, {0, 2});
}

}  // namespace flexneck::pipeline
