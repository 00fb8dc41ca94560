// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "pipeline/parameter_studies/sweep/sweep_summary.h"

namespace flexneck::pipeline {

/// Spearman's rank correlation of each input with an output over the rows that have it; ties get
/// their mean rank. NaN if one does not vary.
/// @param inputs (parameters, rows)
Eigen::VectorXd rank_correlations(const Eigen::MatrixXd& inputs, const Eigen::VectorXd& output);

/// Data shown in the pictures.
struct SweepPictures {
  const SweepRows& sweep;
  const std::vector<OutputColumn>& outputs;
  const SweepTable& table;
  const std::vector<Sensitivity>& sensitivity;
  const std::vector<CurveColumn>& curves;
  const std::vector<Eigen::MatrixXd>& bands;  ///< as returned by percentile_bands()
};

/// Draws into a folder, by gnuplot: sweep-scatter-<output>.svg, the output over each input, at most
/// kMaxPoints rows; sweep-tornado-<output>.svg, indices or effects with their confidence intervals,
/// or the rank correlations for other sampling plans; sweep-bands-<curve>.svg.
/// @return the names of the pictures
/// @throws as run_gnuplot() does.
std::vector<std::string> draw_sweep(const SweepPictures& pictures,
                                    const std::filesystem::path& folder);

}  // namespace flexneck::pipeline
