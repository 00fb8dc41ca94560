// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/history_file.h"

#include <algorithm>
#include <array>
#include <complex>
#include <span>

#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"

namespace flexneck::multibody {
namespace {

constexpr const char* kMarkers = "/markers";
constexpr const char* kJoints = "/joints";
constexpr const char* kModal = "/modal";
constexpr const char* kChannels = "/channels";
constexpr const char* kEnergy = "/energy";
constexpr const char* kConstraints = "/constraints";
constexpr const char* kStatistics = "/statistics";
constexpr const char* kLinearisation = "/linearisation";
/// Position of a group in the model's list: HDF5 itself lists them by name.
constexpr const char* kIndex = "index";
constexpr const char* kUndetermined = "undetermined";
constexpr const char* kIncomplete = "incomplete";
constexpr const char* kRedundant = "/statistics/redundant_constraints";
constexpr const char* kWarnings = "/statistics/warnings";
constexpr const char* kLimits = "/statistics/step_limits";
constexpr const char* kLimitedSteps = "/statistics/limited_steps";
constexpr const char* kModalUnit = "kg^(1/2) m";

/// The vectors of a marker and the fixed-size arrays of a joint with their datasets' names and
/// units: the writer and the reader walk the same list.
template <class Markers, class Visit>
void visit_vectors(Markers& marker, const Visit& visit) {
  visit("position", marker.position_m, "m");
  visit("velocity", marker.velocity_m_s, "m/s");
  visit("acceleration", marker.acceleration_m_s2, "m/s^2");
  visit("rotation", marker.rotation, "1");
  visit("angular_velocity", marker.angular_velocity_rad_s, "rad/s");
  visit("angular_acceleration", marker.angular_acceleration_rad_s2, "rad/s^2");
}

template <class Joints, class Visit>
void visit_reactions(Joints& joint, const Visit& visit) {
  visit("force", joint.force_N, "N");
  visit("moment", joint.moment_Nm, "N m");
}

template <class Energies, class Visit>
void visit_energies(Energies& energy, const Visit& visit) {
  visit("kinetic", energy.kinetic_J);
  visit("gravitational", energy.gravitational_J);
  visit("strain", energy.strain_J);
  visit("dissipated", energy.dissipated_J);
  visit("work", energy.work_J);
}

template <class Constraints, class Visit>
void visit_constraints(Constraints& constraints, const Visit& visit) {
  visit("position", constraints.position_m, "m");
  visit("orientation", constraints.orientation_rad, "rad");
  visit("velocity", constraints.velocity_m_s, "m/s");
  visit("angular_velocity", constraints.angular_velocity_rad_s, "rad/s");
}

/// An Eigen matrix with one column per time is, by its memory, a row-major (n, rows) array.
template <class Matrix>
void write_columns(Hdf5Writer& file, const std::string& dataset, const Matrix& values,
                   std::string_view unit) {
  file.write(dataset, std::span(values.data(), static_cast<std::size_t>(values.size())),
             {static_cast<std::size_t>(values.cols()), static_cast<std::size_t>(values.rows())},
             unit);
}

void write_vector(Hdf5Writer& file, const std::string& dataset, const Eigen::VectorXd& values,
                  std::string_view unit) {
  const auto count = static_cast<std::size_t>(values.size());
  file.write(dataset, std::span(values.data(), count), {count}, unit);
}

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

std::string path_of(const std::string& group, const std::string& name) {
  return group + "/" + name;
}

void write_markers(Hdf5Writer& file, const std::vector<MarkerHistory>& markers) {
  for (std::size_t k = 0; k < markers.size(); ++k) {
    const std::string group = path_of(kMarkers, markers[k].name);
    file.write_attribute(group, kIndex, static_cast<std::int64_t>(k));
    visit_vectors(markers[k], [&](const char* name, const auto& values, const char* unit) {
      write_columns(file, path_of(group, name), values, unit);
    });
  }
}

void write_joints(Hdf5Writer& file, const std::vector<JointHistory>& joints) {
  for (std::size_t k = 0; k < joints.size(); ++k) {
    const std::string group = path_of(kJoints, joints[k].name);
    file.write_attribute(group, kIndex, static_cast<std::int64_t>(k));
    visit_reactions(joints[k], [&](const char* name, const auto& values, const char* unit) {
      write_columns(file, path_of(group, name), values, unit);
    });
    if (!joints[k].undetermined.empty())
      file.write_attribute(group, kUndetermined, std::string_view(joints[k].undetermined));
  }
}

void write_modal(Hdf5Writer& file, const std::vector<ModalHistory>& modal) {
  for (std::size_t k = 0; k < modal.size(); ++k) {
    const std::string group = path_of(kModal, modal[k].body);
    file.write_attribute(group, kIndex, static_cast<std::int64_t>(k));
    write_columns(file, path_of(group, "coordinates"), modal[k].coordinates, kModalUnit);
    file.write(path_of(group, "modes"), modal[k].modes);
  }
}

void write_channels(Hdf5Writer& file, const std::vector<Channel>& channels) {
  for (std::size_t k = 0; k < channels.size(); ++k) {
    const std::string group = path_of(kChannels, channels[k].name);
    file.write_attribute(group, kIndex, static_cast<std::int64_t>(k));
    file.write_attribute(group, "filter", std::string_view(channels[k].filter));
    write_columns(file, path_of(group, "values"), channels[k].values, channels[k].unit);
    file.write(path_of(group, "columns"), channels[k].columns);
  }
}

void write_statistics(Hdf5Writer& file, const StepStatistics& statistics) {
  file.write_attribute(kStatistics, "accepted", std::int64_t{statistics.accepted});
  file.write_attribute(kStatistics, "rejected", std::int64_t{statistics.rejected});
  file.write_attribute(kStatistics, "evaluations", std::int64_t{statistics.evaluations});
  file.write_attribute(kStatistics, "largest_position_residual",
                       statistics.largest_position_residual);
  file.write_attribute(kStatistics, "largest_velocity_residual",
                       statistics.largest_velocity_residual);
  if (statistics.limits.empty()) return;
  std::vector<std::string> limits;
  Eigen::VectorXd steps(static_cast<Eigen::Index>(statistics.limits.size()));
  for (const StepLimit& limit : statistics.limits) {
    steps[static_cast<Eigen::Index>(limits.size())] = limit.steps;
    limits.push_back(limit.what);
  }
  file.write(kLimits, limits);
  write_vector(file, kLimitedSteps, steps, "1");
}

struct ModeNumber {
  const char* name;
  double SystemMode::*member;
  const char* unit;
};
constexpr std::array<ModeNumber, 4> kModeNumbers = {
    {{"frequency", &SystemMode::frequency_Hz, "Hz"},
     {"damped_frequency", &SystemMode::damped_frequency_Hz, "Hz"},
     {"damping_ratio", &SystemMode::damping_ratio, "1"},
     {"growth_rate", &SystemMode::growth_rate_1_s, "1/s"}}};

struct ShapePart {
  const char* name;
  Eigen::Matrix3Xcd ModeShape::*member;
  const char* unit;
};
constexpr std::array<ShapePart, 2> kShapeParts = {
    {{"translation", &ModeShape::translation, "m"}, {"rotation", &ModeShape::rotation, "rad"}}};

void write_linearisation(Hdf5Writer& file, const LinearisationRecord& record) {
  const std::size_t n = record.modes.size();
  file.write_attribute(kLinearisation, "about", std::string_view(record.about));
  file.write(path_of(kLinearisation, "markers"), record.markers);
  for (const ModeNumber& number : kModeNumbers) {
    std::vector<double> values;
    for (const ModeShape& mode : record.modes) values.push_back(mode.mode.*number.member);
    file.write(path_of(kLinearisation, number.name), values, {n}, number.unit);
  }
  for (const ShapePart& part : kShapeParts) {
    std::vector<double> real;
    std::vector<double> imaginary;
    for (const ModeShape& mode : record.modes)
      for (const std::complex<double>& each : (mode.*part.member).reshaped()) {
        real.push_back(each.real());
        imaginary.push_back(each.imag());
      }
    const std::string name = path_of(kLinearisation, part.name);
    file.write(name + "_real", real, {n, record.markers.size(), 3}, part.unit);
    file.write(name + "_imaginary", imaginary, {n, record.markers.size(), 3}, part.unit);
  }
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

StepStatistics read_statistics(const Hdf5Reader& file) {
  const auto count = [&](const char* name) {
    return static_cast<int>(file.integer_attribute(kStatistics, name));
  };
  StepStatistics statistics;
  statistics.accepted = count("accepted");
  statistics.rejected = count("rejected");
  statistics.evaluations = count("evaluations");
  statistics.largest_position_residual =
      file.double_attribute(kStatistics, "largest_position_residual");
  statistics.largest_velocity_residual =
      file.double_attribute(kStatistics, "largest_velocity_residual");
  if (!file.has(kLimits)) return statistics;
  const std::vector<std::string> limits = file.read_strings(kLimits);
  const Eigen::VectorXd steps = read_vector(file, kLimitedSteps, limits.size(), "1");
  for (std::size_t k = 0; k < limits.size(); ++k)
    statistics.limits.push_back({limits[k], static_cast<int>(steps[static_cast<Eigen::Index>(k)])});
  return statistics;
}

LinearisationRecord read_linearisation(const Hdf5Reader& file) {
  LinearisationRecord record;
  record.about = file.string_attribute(kLinearisation, "about");
  record.markers = file.read_strings(path_of(kLinearisation, "markers"));
  for (const ModeNumber& number : kModeNumbers) {
    // Files of earlier versions hold stable modes only, without their growth.
    const bool may_lack = number.member == &SystemMode::growth_rate_1_s;
    if (may_lack && !file.has(path_of(kLinearisation, number.name))) continue;
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
  const Eigen::VectorXd time_s = read_vector(file, "/time", kAnyExtent, "s");
  for (Eigen::Index k = 1; k < time_s.size(); ++k) {
    if (!(time_s[k] > time_s[k - 1])) {
      file.refuse("/time", "row " + std::to_string(k + 1) + " is not later than the one before");
    }
  }
  return time_s;
}

void check_group_names(const History& history) {
  check_names(names_of(history.markers), "marker");
  check_names(names_of(history.joints), "joint");
  std::vector<std::string> bodies;
  for (const ModalHistory& modal : history.modal) bodies.push_back(modal.body);
  check_names(bodies, "body");
}

}  // namespace

void write_history(const std::filesystem::path& path, const HistoryFile& file) {
  const History& history = file.history;
  check_group_names(history);
  check_names(names_of(file.channels), "channel");
  Hdf5Writer writer(path, kHistoryFormat);
  write_vector(writer, "/time", history.time_s, "s");
  write_markers(writer, history.markers);
  write_joints(writer, history.joints);
  write_modal(writer, history.modal);
  write_channels(writer, file.channels);
  visit_energies(history.energy, [&](const char* name, const Eigen::VectorXd& values) {
    write_vector(writer, path_of(kEnergy, name), values, "J");
  });
  visit_constraints(history.constraints,
                    [&](const char* name, const Eigen::VectorXd& values, const char* unit) {
                      write_vector(writer, path_of(kConstraints, name), values, unit);
                    });
  write_statistics(writer, history.statistics);
  if (!history.redundant_constraints.empty())
    writer.write(kRedundant, history.redundant_constraints);
  if (!history.warnings.empty()) writer.write(kWarnings, history.warnings);
  if (!history.incomplete.empty())
    writer.write_attribute(kStatistics, kIncomplete, std::string_view(history.incomplete));
  if (file.linearisation) write_linearisation(writer, *file.linearisation);
  write_provenance(writer, file.provenance);
  writer.commit();
}

HistoryFile read_history(const std::filesystem::path& path) {
  const Hdf5Reader reader(path, kHistoryFormat);
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
  for (const std::string& name : ordered_members(reader, kChannels)) {
    file.channels.push_back(read_channel(reader, name, times));
  }
  visit_energies(history.energy, [&](const char* name, Eigen::VectorXd& values) {
    values = read_vector(reader, path_of(kEnergy, name), times, "J");
  });
  // Files of earlier versions have none.
  if (reader.has(kConstraints))
    visit_constraints(history.constraints,
                      [&](const char* name, Eigen::VectorXd& values, const char* unit) {
                        values = read_vector(reader, path_of(kConstraints, name), times, unit);
                      });
  history.statistics = read_statistics(reader);
  if (reader.has(kRedundant)) history.redundant_constraints = reader.read_strings(kRedundant);
  if (reader.has(kWarnings)) history.warnings = reader.read_strings(kWarnings);
  if (has_attribute(reader, kStatistics, kIncomplete))
    history.incomplete = reader.string_attribute(kStatistics, kIncomplete);
  if (reader.has(kLinearisation)) file.linearisation = read_linearisation(reader);
  file.provenance = read_provenance(reader);
  return file;
}

}  // namespace flexneck::multibody
