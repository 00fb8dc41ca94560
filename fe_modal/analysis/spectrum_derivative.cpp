// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/analysis/spectrum_derivative.h"

#include <cmath>
#include <numbers>

#include "geometry/foundation/output_file.h"
#include "geometry/foundation/symmetric_pairs.h"

namespace flexneck::fe_modal {
namespace {

/// lambda = (2 pi f)^2, so that df = d lambda / (8 pi^2 f).
constexpr double kEightPiSquared = 8 * std::numbers::pi * std::numbers::pi;

std::string joined_names(const Spectrum& spectrum, const ModeGroup& group) {
  std::string names;
  for (Eigen::Index k = 0; k < group.count; ++k) {
    names += (k > 0 ? ", " : "") + spectrum.names[static_cast<std::size_t>(group.first + k)];
  }
  return names;
}

/// Appends a row of derivatives.
/// @param by_parameter d lambda for each parameter
void add_row(QuantityKind kind, const std::string& name, double frequency_Hz, bool is_attached,
             const Eigen::VectorXd& by_parameter, Sensitivities& result) {
  result.quantities.push_back({kind, name, "Hz", frequency_Hz, is_attached});
  const Eigen::Index row = result.derivatives.rows();
  result.derivatives.conservativeResize(row + 1, by_parameter.size());
  result.derivatives.row(row) = by_parameter.transpose() / (kEightPiSquared * frequency_Hz);
}

/// Largest product of an entry off the diagonal with its parameter, over the eigenvalue; for a
/// parameter that is zero, the entry over the largest of the diagonal.
double coupling(const GroupDerivative& derivative, const std::vector<DesignParameter>& parameters,
                double lambda) {
  double largest = 0;
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    Eigen::MatrixXd off = derivative.by_parameter[p];
    const double diagonal = off.diagonal().cwiseAbs().maxCoeff();
    off.diagonal().setZero();
    const double entry = off.cwiseAbs().maxCoeff();
    if (entry == 0) continue;
    const double value = std::abs(parameters[p].value);
    largest = std::max(largest, value > 0 ? entry * value / lambda : entry / diagonal);
  }
  return largest;
}

std::string group_note(const std::string& names, double spread, double coupled) {
  return names + " are within " + rounded_text(100 * spread, 2) +
         " % of one another; shown are the mean and the directional derivatives" +
         (coupled < kUncoupled ? ", also by symmetry class, since no parameter couples the classes"
                               : "; coupled by the parameters") +
         " (" + rounded_text(coupled, 2) + ")";
}

}  // namespace

std::vector<ModeGroup> groups_of(const Eigen::VectorXd& frequencies_Hz) {
  std::vector<ModeGroup> groups;
  for (Eigen::Index k = 0; k < frequencies_Hz.size(); ++k) {
    const bool joins =
        k > 0 && frequencies_Hz[k] - frequencies_Hz[k - 1] < kNearlyEqual * frequencies_Hz[k];
    if (joins) {
      ++groups.back().count;
    } else {
      groups.push_back({k, 1});
    }
  }
  return groups;
}

void add_group(const Spectrum& spectrum, const GroupDerivative& derivative, Sensitivities& result) {
  const ModeGroup& group = derivative.group;
  const auto parameters = static_cast<Eigen::Index>(derivative.by_parameter.size());
  const Eigen::VectorXd frequencies = spectrum.frequencies_Hz.segment(group.first, group.count);
  Eigen::MatrixXd of_class(group.count, parameters);
  Eigen::MatrixXd directional(group.count, parameters);
  for (Eigen::Index p = 0; p < parameters; ++p) {
    const Eigen::MatrixXd& matrix = derivative.by_parameter[static_cast<std::size_t>(p)];
    of_class.col(p) = matrix.diagonal();
    directional.col(p) = symmetric_eigenvalues(matrix);
  }
  const auto add_each = [&](QuantityKind kind) {
    for (Eigen::Index k = 0; k < group.count; ++k) {
      add_row(kind, spectrum.names[static_cast<std::size_t>(group.first + k)], frequencies[k],
              spectrum.is_attached, of_class.row(k).transpose(), result);
    }
  };
  if (group.count == 1) {
    add_each(QuantityKind::frequency);
    return;
  }
  const std::string names = joined_names(spectrum, group);
  const double mean_Hz = std::sqrt(frequencies.squaredNorm() / static_cast<double>(group.count));
  add_row(QuantityKind::mean_frequency, names, mean_Hz, spectrum.is_attached,
          of_class.colwise().mean().transpose(), result);
  // The lowest derivative belongs to a mixture of the modes, not to one of them.
  for (Eigen::Index k = 0; k < group.count; ++k) {
    add_row(QuantityKind::directional, names + " (" + std::to_string(k + 1) + ")", mean_Hz,
            spectrum.is_attached, directional.row(k).transpose(), result);
  }
  const double lambda = 4 * std::pow(std::numbers::pi * mean_Hz, 2);
  const double coupled = coupling(derivative, result.parameters, lambda);
  if (coupled < kUncoupled) add_each(QuantityKind::symmetry_class);
  result.notes.push_back(
      group_note(names, frequencies[group.count - 1] / frequencies[0] - 1, coupled));
}

}  // namespace flexneck::fe_modal
