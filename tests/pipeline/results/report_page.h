// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "geometry/foundation/input_file.h"
#include "multibody/files/history_file.h"
#include "pipeline/results/report/report.h"
#include "pipeline/results/report/results.h"
#include "pipeline/run/results_folder.h"

namespace flexneck::testing {

inline const pipeline::Study& built_in() {
  static const pipeline::Study study = pipeline::read_study(pipeline::built_in_study(), {});
  return study;
}

/// A run of the pendulum with two channels and nothing else.
inline multibody::HistoryFile small_run(int samples) {
  multibody::HistoryFile file;
  file.history.time_s = Eigen::VectorXd::LinSpaced(samples, 0, 0.01 * (samples - 1));
  for (Eigen::VectorXd* energy :
       {&file.history.energy.kinetic_J, &file.history.energy.gravitational_J,
        &file.history.energy.strain_J, &file.history.energy.dissipated_J,
        &file.history.energy.work_J, &file.history.constraints.position_m,
        &file.history.constraints.orientation_rad, &file.history.constraints.velocity_m_s,
        &file.history.constraints.angular_velocity_rad_s}) {
    *energy = Eigen::VectorXd::Zero(samples);
  }
  const Eigen::RowVectorXd ramp = file.history.time_s.transpose();
  file.channels = {{"head rotation", "rad", {"angle"}, ramp, ""},
                   {"neck rotation", "rad", {"angle"}, 0.5 * ramp, ""}};
  file.provenance = pipeline::provenance_of(built_in());
  return file;
}

inline std::string page_of(const std::filesystem::path& folder) {
  pipeline::write_report(folder / "report.html", pipeline::read_results(folder, built_in()),
                         built_in());
  return text_of_file(folder / "report.html");
}

inline std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

}  // namespace flexneck::testing
