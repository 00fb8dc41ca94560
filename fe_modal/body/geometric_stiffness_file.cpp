// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/body/geometric_stiffness_file.h"

namespace flexneck::fe_modal {
namespace {

constexpr const char* kGroup = "/geometric_stiffness";
constexpr std::string_view kPerModeUnit = "kg^-0.5 m^-1";
constexpr std::string_view kPerForceUnit = "1/(kg m)";
constexpr std::string_view kPerMomentUnit = "1/(kg m^2)";

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Writes k square matrices of the modes, (k, m, m).
void write_squares(Hdf5Writer& file, const std::string& dataset,
                   const std::vector<Eigen::MatrixXd>& squares, std::string_view unit) {
  std::vector<double> values;
  for (const RowMajor square : squares) {
    values.insert(values.end(), square.data(), square.data() + square.size());
  }
  const auto m = static_cast<std::size_t>(squares.front().rows());
  file.write(dataset, values, {squares.size(), m, m}, unit);
}

std::vector<Eigen::MatrixXd> read_squares(const Hdf5Reader& file, const std::string& dataset,
                                          std::size_t count, std::size_t m, std::string_view unit) {
  const std::vector<double> values = file.read_doubles(dataset, {count, m, m}, unit);
  std::vector<Eigen::MatrixXd> squares;
  for (std::size_t k = 0; k < count; ++k) {
    squares.emplace_back(Eigen::Map<const RowMajor>(
        values.data() + k * m * m, static_cast<Eigen::Index>(m), static_cast<Eigen::Index>(m)));
  }
  return squares;
}

}  // namespace

void write_geometric_stiffness(Hdf5Writer& file, const GeometricStiffness& stiffness) {
  const std::string group = kGroup;
  write_squares(file, group + "/acceleration", stiffness.acceleration, "1/m");
  write_squares(file, group + "/angular_acceleration", stiffness.angular_acceleration, "1");
  write_squares(file, group + "/velocity_products", stiffness.velocity_products, "1");
  write_squares(file, group + "/modal_acceleration", stiffness.modal_acceleration, kPerModeUnit);
  for (const GeometricStiffness::OfInterface& loads : stiffness.interfaces) {
    const std::string interface = group + "/interfaces/" + loads.name;
    write_squares(file, interface + "/force", loads.force, kPerForceUnit);
    write_squares(file, interface + "/moment", loads.moment, kPerMomentUnit);
  }
}

std::optional<GeometricStiffness> read_geometric_stiffness(const Hdf5Reader& file, std::size_t m) {
  if (!file.has(kGroup)) return std::nullopt;
  const std::string group = kGroup;
  GeometricStiffness stiffness{
      read_squares(file, group + "/acceleration", 3, m, "1/m"),
      read_squares(file, group + "/angular_acceleration", 3, m, "1"),
      read_squares(file, group + "/velocity_products", 6, m, "1"),
      read_squares(file, group + "/modal_acceleration", m, m, kPerModeUnit),
      {}};
  for (const std::string& name : file.members(group + "/interfaces")) {
    const std::string interface = group + "/interfaces/" + name;
    stiffness.interfaces.push_back(
        {name, read_squares(file, interface + "/force", 3, m, kPerForceUnit),
         read_squares(file, interface + "/moment", 3, m, kPerMomentUnit)});
  }
  return stiffness;
}

}  // namespace flexneck::fe_modal
