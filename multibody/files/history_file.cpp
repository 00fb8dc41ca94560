// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/files/history_file.h"

#include <algorithm>
#include <limits>

#include "geometry/foundation/available_memory.h"
#include "geometry/foundation/output_file.h"
#include "multibody/files/history_layout.h"

namespace flexneck::multibody {
namespace {

template <class Matrix>
Matrix read_columns(const Hdf5Reader& file, const std::string& dataset, std::size_t times,
                    std::size_t rows, std::string_view unit) {
  const std::vector<double> values = file.read_doubles(dataset, {times, rows}, unit);
  return Eigen::Map<const Eigen::MatrixXd>(values.data(), static_cast<Eigen::Index>(rows),
                                           static_cast<Eigen::Index>(times));
}

Eigen::VectorXd read_vector(const Hdf5Reader& file, const std::string& dataset, std::size_t times,
                            std::string_view unit) {
  const std::vector<double> values = file.read_doubles(dataset, {times}, unit);
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

/// Members of a group in the order of their attribute `index`.
std::vector<std::string> ordered_members(const Hdf5Reader& file, const std::string& group) {
  const std::vector<std::string> members = file.members(group);
  std::vector<std::string> ordered(members.size());
  for (const std::string& member : members) {
    const std::int64_t index = file.integer_attribute(path_of(group, member), kIndex);
    if (index < 0 || index >= static_cast<std::int64_t>(members.size()) ||
        !ordered[static_cast<std::size_t>(index)].empty()) {
      file.refuse(path_of(group, member),
                  "its attribute 'index' must count the " + std::to_string(members.size()) +
                      " members of its group, but is " + std::to_string(index));
    }
    ordered[static_cast<std::size_t>(index)] = member;
  }
  return ordered;
}

bool has_attribute(const Hdf5Reader& file, const std::string& object, const std::string& name) {
  const std::vector<std::string> names = file.attributes(object);
  return std::find(names.begin(), names.end(), name) != names.end();
}

MarkerHistory read_marker(const Hdf5Reader& file, const std::string& name, std::size_t times) {
  MarkerHistory marker;
  marker.name = name;
  visit_vectors(marker, [&](const char* dataset, auto& values, const char* unit) {
    using Matrix = std::remove_reference_t<decltype(values)>;
    values = read_columns<Matrix>(file, path_of(path_of(kMarkers, name), dataset), times,
                                  Matrix::RowsAtCompileTime, unit);
  });
  return marker;
}

JointHistory read_joint(const Hdf5Reader& file, const std::string& name, std::size_t times) {
  JointHistory joint;
  joint.name = name;
  visit_reactions(joint, [&](const char* dataset, Eigen::Matrix3Xd& values, const char* unit) {
    values = read_columns<Eigen::Matrix3Xd>(file, path_of(path_of(kJoints, name), dataset), times,
                                            3, unit);
  });
  if (has_attribute(file, path_of(kJoints, name), kUndetermined))
    joint.undetermined = file.string_attribute(path_of(kJoints, name), kUndetermined);
  return joint;
}

ModalHistory read_modal(const Hdf5Reader& file, const std::string& body, std::size_t times) {
  const std::string group = path_of(kModal, body);
  ModalHistory modal;
  modal.body = body;
  modal.modes = file.read_strings(path_of(group, "modes"));
  modal.coordinates = read_columns<Eigen::MatrixXd>(file, path_of(group, "coordinates"), times,
                                                    modal.modes.size(), kModalUnit);
  return modal;
}

/// Reads a matrix with as many rows as the file has.
Eigen::MatrixXd read_rows(const Hdf5Reader& file, const std::string& dataset, std::size_t times,
                          std::string_view unit) {
  const Shape shape = file.shape(dataset);
  return read_columns<Eigen::MatrixXd>(file, dataset, times, shape.size() == 2 ? shape[1] : 0,
                                       unit);
}

BodyHistory read_state(const Hdf5Reader& file, const std::string& name, std::size_t times) {
  BodyHistory body;
  body.name = name;
  visit_state(body, [&](const char* dataset, auto& values, const char* unit) {
    using Matrix = std::remove_reference_t<decltype(values)>;
    const std::string path = path_of(path_of(kStates, name), dataset);
    if constexpr (Matrix::RowsAtCompileTime == Eigen::Dynamic)
      values = read_rows(file, path, times, unit);
    else
      values = read_columns<Matrix>(file, path, times, Matrix::RowsAtCompileTime, unit);
  });
  if (const std::string inertia = path_of(path_of(kStates, name), kInertia); file.has(inertia))
    body.inertia = read_vector(file, inertia, 10, kInertiaUnit);
  if (body.modal_rate.rows() != body.modal.rows())
    file.refuse(path_of(kStates, name), "expected as many modal rates as modal coordinates");
  return body;
}

Channel read_channel(const Hdf5Reader& file, const std::string& name, std::size_t times) {
  const std::string group = path_of(kChannels, name);
  Channel channel;
  channel.name = name;
  channel.filter = file.string_attribute(group, "filter");
  channel.unit = file.string_attribute(path_of(group, "values"), "units");
  channel.columns = file.read_strings(path_of(group, "columns"));
  channel.values = read_columns<Eigen::MatrixXd>(file, path_of(group, "values"), times,
                                                 channel.columns.size(), channel.unit);
  return channel;
}

/// Checks a number of steps, which must be whole and within the range of int.
template <class Number>
int count_from(const Hdf5Reader& file, const std::string& object, Number number) {
  constexpr auto kMost = static_cast<Number>(std::numeric_limits<int>::max());
  if (!(number >= 0 && number <= kMost) || static_cast<Number>(static_cast<int>(number)) != number)
    file.refuse(object,
                "expected a number of steps, found " + rounded_text(static_cast<double>(number)));
  return static_cast<int>(number);
}

StepStatistics read_statistics(const Hdf5Reader& file) {
  const auto count = [&](const std::string& name) {
    return count_from(file, path_of(kStatistics, name), file.integer_attribute(kStatistics, name));
  };
  StepStatistics statistics;
  statistics.accepted = count("accepted");
  statistics.rejected = count("rejected");
  statistics.evaluations = count("evaluations");
  statistics.max_position_residual =
      file.double_attribute(kStatistics, "largest_position_residual");
  statistics.max_velocity_residual =
      file.double_attribute(kStatistics, "largest_velocity_residual");
  if (!file.has(kLimits)) return statistics;
  const std::vector<std::string> limits = file.read_strings(kLimits);
  const Eigen::VectorXd steps = read_vector(file, kLimitedSteps, limits.size(), "1");
  for (std::size_t k = 0; k < limits.size(); ++k)
    statistics.limits.push_back(
        {limits[k], count_from(file, kLimitedSteps, steps[static_cast<Eigen::Index>(k)])});
  return statistics;
}

LinearisationRecord read_linearisation(const Hdf5Reader& file) {
  LinearisationRecord record;
  record.about = file.string_attribute(kLinearisation, "about");
  record.markers = file.read_strings(path_of(kLinearisation, "markers"));
  for (const ModeNumber& number : kModeNumbers) {
    const std::vector<double> values =
        file.read_doubles(path_of(kLinearisation, number.name),
                          {record.modes.empty() ? kAnyExtent : record.modes.size()}, number.unit);
    record.modes.resize(values.size());
    for (std::size_t k = 0; k < values.size(); ++k) record.modes[k].mode.*number.member = values[k];
  }
  const Shape shape = {record.modes.size(), record.markers.size(), 3};
  const auto columns = static_cast<Eigen::Index>(record.markers.size());
  for (const ShapePart& part : kShapeParts) {
    const std::string name = path_of(kLinearisation, part.name);
    const std::vector<double> real = file.read_doubles(name + "_real", shape, part.unit);
    const std::vector<double> imaginary = file.read_doubles(name + "_imaginary", shape, part.unit);
    for (std::size_t k = 0; k < record.modes.size(); ++k) {
      Eigen::Matrix3Xcd& amplitudes = record.modes[k].*part.member;
      const std::size_t first = 3 * record.markers.size() * k;
      amplitudes.resize(3, columns);
      amplitudes.real() = Eigen::Map<const Eigen::Matrix3Xd>(real.data() + first, 3, columns);
      amplitudes.imag() = Eigen::Map<const Eigen::Matrix3Xd>(imaginary.data() + first, 3, columns);
    }
  }
  return record;
}

Eigen::VectorXd read_time(const Hdf5Reader& file) {
  Eigen::VectorXd time_s = read_vector(file, "/time", kAnyExtent, "s");
  for (Eigen::Index k = 1; k < time_s.size(); ++k) {
    if (!(time_s[k] > time_s[k - 1])) {
      file.refuse("/time", "row " + std::to_string(k + 1) + " is not later than the row before it");
    }
  }
  return time_s;
}

}  // namespace

HistoryFile read_history(const std::filesystem::path& path) {
  const Hdf5Reader reader(path, kHistoryFormat);
  constexpr double kFew = 1e8;
  const auto bytes = static_cast<double>(std::filesystem::file_size(path));
  if (bytes > kFew) {
    require_memory(path.string() + ": the history", bytes, "read its datasets in parts");
  }
  HistoryFile file;
  History& history = file.history;
  history.time_s = read_time(reader);
  const auto times = static_cast<std::size_t>(history.time_s.size());
  for (const std::string& name : ordered_members(reader, kMarkers)) {
    history.markers.push_back(read_marker(reader, name, times));
  }
  for (const std::string& name : ordered_members(reader, kJoints)) {
    history.joints.push_back(read_joint(reader, name, times));
  }
  for (const std::string& name : ordered_members(reader, kModal)) {
    history.modal.push_back(read_modal(reader, name, times));
  }
  for (const std::string& name : ordered_members(reader, kStates))
    history.state.bodies.push_back(read_state(reader, name, times));
  if (!history.state.bodies.empty())
    history.state.internal = read_rows(reader, kInternal, times, "m, rad");
  if (reader.has(kAngleNames)) {
    history.state.angle_names = reader.read_strings(kAngleNames);
    history.state.angles = read_columns<Eigen::MatrixXd>(reader, kAngles, times,
                                                         history.state.angle_names.size(), "rad");
  }
  for (const std::string& name : ordered_members(reader, kChannels)) {
    file.channels.push_back(read_channel(reader, name, times));
  }
  visit_energies(history.energy, [&](const char* name, Eigen::VectorXd& values) {
    values = read_vector(reader, path_of(kEnergy, name), times, "J");
  });
  visit_constraints(history.constraints,
                    [&](const char* name, Eigen::VectorXd& values, const char* unit) {
                      values = read_vector(reader, path_of(kConstraints, name), times, unit);
                    });
  history.statistics = read_statistics(reader);
  if (has_attribute(reader, kStatistics, kFreedoms))
    history.freedoms = count_from(reader, path_of(kStatistics, kFreedoms),
                                  reader.integer_attribute(kStatistics, kFreedoms));
  if (reader.has(kRedundant)) history.redundant_constraints = reader.read_strings(kRedundant);
  if (reader.has(kWarnings)) history.warnings = reader.read_strings(kWarnings);
  if (has_attribute(reader, kStatistics, kIncomplete))
    history.incomplete = reader.string_attribute(kStatistics, kIncomplete);
  if (reader.has(kLinearisation)) file.linearisation = read_linearisation(reader);
  file.provenance = read_provenance(reader);
  return file;
}

}  // namespace flexneck::multibody
