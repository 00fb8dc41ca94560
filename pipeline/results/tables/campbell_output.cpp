// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/results/tables/campbell_output.h"

#include <array>
#include <numbers>
#include <string>
#include <vector>

#include "geometry/foundation/input_file.h"
#include "geometry/foundation/output_file.h"
#include "geometry/foundation/temporary_folder.h"
#include "multibody/analysis/linearisation.h"
#include "pipeline/results/plotting/curve_figure.h"
#include "pipeline/results/plotting/embedding.h"
#include "pipeline/results/plotting/gnuplot.h"
#include "pipeline/results/tables/csv_output.h"

namespace flexneck::pipeline {

using Eigen::VectorXd;
using multibody::SystemMode;

namespace {

struct ModeQuantity {
  const char* name;
  const char* unit;
  double SystemMode::*member;
};
constexpr std::array<ModeQuantity, 3> kQuantities = {
    {{"frequency", "Hz", &SystemMode::frequency_Hz},
     {"damping ratio", "1", &SystemMode::damping_ratio},
     {"growth rate", "1/s", &SystemMode::growth_rate_1_s}}};

VectorXd over_rates(const std::vector<SystemMode>& mode, double SystemMode::*member) {
  VectorXd values(static_cast<Eigen::Index>(mode.size()));
  for (std::size_t r = 0; r < mode.size(); ++r)
    values[static_cast<Eigen::Index>(r)] = mode[r].*member;
  return values;
}

VectorXd rates_of(const multibody::CampbellDiagram& diagram) {
  return Eigen::Map<const VectorXd>(diagram.rates_rad_s.data(),
                                    static_cast<Eigen::Index>(diagram.rates_rad_s.size()));
}

std::string name_of(std::size_t mode) { return "mode " + std::to_string(mode + 1); }

}  // namespace

void write_campbell_table(const std::filesystem::path& path,
                          const multibody::CampbellDiagram& diagram) {
  std::vector<multibody::Channel> channels;
  for (std::size_t k = 0; k < diagram.modes.size(); ++k)
    for (const ModeQuantity& each : kQuantities)
      channels.push_back({name_of(k) + " " + each.name,
                          each.unit,
                          {each.name},
                          over_rates(diagram.modes[k], each.member).transpose(),
                          ""});
  write_csv(path, rates_of(diagram), channels, "rate [rad/s]");
}

void draw_campbell(const std::filesystem::path& path, const multibody::CampbellDiagram& diagram) {
  const VectorXd rates = rates_of(diagram);
  CurvePlot plot{"rate [rad/s]", "frequency in the rotating frame [Hz]", {}};
  plot.note = "";
  for (std::size_t k = 0; k < diagram.modes.size(); ++k)
    plot.curves.push_back(
        {name_of(k), rates, over_rates(diagram.modes[k], &SystemMode::frequency_Hz)});
  plot.curves.push_back({"one per revolution", rates, rates / (2 * std::numbers::pi)});
  Figure figure;
  draw_curves(plot, figure);
  const TemporaryFolder workshop;
  const std::string script = "campbell.gp";
  write_text(workshop / (stem_of(figure) + ".csv"), figure.csv, Durability::none);
  write_text(workshop / script, figure.script + "set output\n", Durability::none);
  run_gnuplot(workshop.path(), script);
  write_text(path, text_of_file(workshop / (stem_of(figure) + ".svg")), Durability::none);
}

}  // namespace flexneck::pipeline
