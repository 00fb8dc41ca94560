// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/files/history_writer.h"

#include <complex>
#include <span>
#include <utility>

#include "geometry/foundation/names.h"
#include "multibody/files/history_layout.h"
#include "multibody/history/history_arrays.h"

namespace flexneck::multibody {
namespace {

void check_group_names(const History& history) {
  check_names(names_of(history.markers), "marker");
  check_names(names_of(history.joints), "joint");
  std::vector<std::string> bodies;
  for (const ModalHistory& modal : history.modal) bodies.push_back(modal.body);
  check_names(bodies, "body");
  check_names(names_of(history.state.bodies), "body");
}

std::span<const double> numbers_of(const auto& values) {
  return {values.data(), static_cast<std::size_t>(values.size())};
}

/// Calls put(dataset, values, unit) for each array that has a column, or an entry, per time.
template <class Put>
void put_arrays(const History& history, const std::vector<Channel>& channels, const Put& put) {
  const auto into = [&](const std::string& group) {
    return [&put, group](const char* name, const auto& values, const char* unit) {
      put(path_of(group, name), values, unit);
    };
  };
  put("/time", history.time_s, "s");
  for (const MarkerHistory& marker : history.markers)
    visit_vectors(marker, into(path_of(kMarkers, marker.name)));
  for (const JointHistory& joint : history.joints)
    visit_reactions(joint, into(path_of(kJoints, joint.name)));
  for (const ModalHistory& modal : history.modal)
    put(path_of(path_of(kModal, modal.body), "coordinates"), modal.coordinates, kModalUnit);
  for (const BodyHistory& body : history.state.bodies)
    visit_state(body, into(path_of(kStates, body.name)));
  if (!history.state.bodies.empty()) {
    put(kInternal, history.state.internal, "m, rad");
    put(kAngles, history.state.angles, "rad");
  }
  for (const Channel& channel : channels)
    put(path_of(path_of(kChannels, channel.name), "values"), channel.values, channel.unit);
  visit_energies(history.energy, [&](const char* name, const Eigen::VectorXd& values) {
    put(path_of(kEnergy, name), values, "J");
  });
  visit_constraints(history.constraints, into(kConstraints));
}

void write_vector(Hdf5Writer& file, const std::string& dataset, const Eigen::VectorXd& values,
                  std::string_view unit) {
  file.write(dataset, numbers_of(values), {static_cast<std::size_t>(values.size())}, unit);
}

/// Appends the arrays of a history. An Eigen matrix with one column per time has the memory layout
/// of a row-major (n, rows) array. Arrays of bodies without modes have no numbers: they are written
/// at the end.
void append_columns(Hdf5Writer& file, const History& history,
                    const std::vector<Channel>& channels) {
  put_arrays(history, channels,
             [&](const std::string& dataset, const auto& values, std::string_view unit) {
               Shape row = {static_cast<std::size_t>(values.rows())};
               if (kIsOnePerTime<decltype(values)>) row = {};
               if (row != Shape{0}) file.append(dataset, numbers_of(values), row, unit);
             });
}

void write_empty(Hdf5Writer& file, const History& history, const std::vector<Channel>& channels) {
  const auto times = static_cast<std::size_t>(history.handed_on + history.time_s.size());
  put_arrays(history, channels,
             [&](const std::string& dataset, const auto& values, std::string_view unit) {
               const bool has_rows = !kIsOnePerTime<decltype(values)>;
               if (has_rows && values.rows() == 0) file.write(dataset, {}, {times, 0}, unit);
             });
}

void write_index(Hdf5Writer& file, const std::string& group, std::size_t index) {
  file.write_attribute(group, kIndex, static_cast<std::int64_t>(index));
}

/// Writes the content of the groups other than their arrays.
void write_groups(Hdf5Writer& file, const History& history, const std::vector<Channel>& channels) {
  for (std::size_t k = 0; k < history.markers.size(); ++k)
    write_index(file, path_of(kMarkers, history.markers[k].name), k);
  for (std::size_t k = 0; k < history.joints.size(); ++k) {
    const JointHistory& joint = history.joints[k];
    const std::string group = path_of(kJoints, joint.name);
    write_index(file, group, k);
    if (!joint.undetermined.empty())
      file.write_attribute(group, kUndetermined, std::string_view(joint.undetermined));
  }
  for (std::size_t k = 0; k < history.modal.size(); ++k) {
    const std::string group = path_of(kModal, history.modal[k].body);
    write_index(file, group, k);
    file.write(path_of(group, "modes"), history.modal[k].modes);
  }
  for (std::size_t k = 0; k < history.state.bodies.size(); ++k) {
    const BodyHistory& body = history.state.bodies[k];
    const std::string group = path_of(kStates, body.name);
    write_index(file, group, k);
    if (body.inertia.size() > 0)
      write_vector(file, path_of(group, kInertia), body.inertia, kInertiaUnit);
  }
  if (!history.state.angle_names.empty()) file.write(kAngleNames, history.state.angle_names);
  for (std::size_t k = 0; k < channels.size(); ++k) {
    const std::string group = path_of(kChannels, channels[k].name);
    write_index(file, group, k);
    file.write_attribute(group, "filter", std::string_view(channels[k].filter));
    file.write(path_of(group, "columns"), channels[k].columns);
  }
}

void write_statistics(Hdf5Writer& file, const StepStatistics& statistics) {
  file.write_attribute(kStatistics, "accepted", std::int64_t{statistics.accepted});
  file.write_attribute(kStatistics, "rejected", std::int64_t{statistics.rejected});
  file.write_attribute(kStatistics, "evaluations", std::int64_t{statistics.evaluations});
  file.write_attribute(kStatistics, "largest_position_residual", statistics.max_position_residual);
  file.write_attribute(kStatistics, "largest_velocity_residual", statistics.max_velocity_residual);
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

/// Writes the data of the run as a whole.
void write_run(Hdf5Writer& file, const HistoryFile& run) {
  const History& history = run.history;
  write_statistics(file, history.statistics);
  if (history.freedoms >= 0)
    file.write_attribute(kStatistics, kFreedoms, std::int64_t{history.freedoms});
  if (!history.redundant_constraints.empty()) file.write(kRedundant, history.redundant_constraints);
  if (!history.warnings.empty()) file.write(kWarnings, history.warnings);
  if (!history.incomplete.empty())
    file.write_attribute(kStatistics, kIncomplete, std::string_view(history.incomplete));
  if (run.linearisation) write_linearisation(file, *run.linearisation);
  write_provenance(file, run.provenance);
}

}  // namespace

HistoryWriter::HistoryWriter(std::filesystem::path path) : file_(std::move(path), kHistoryFormat) {}

void HistoryWriter::append(const History& outputs, const std::vector<Channel>& channels) {
  append_columns(file_, outputs, channels);
}

void HistoryWriter::finish(const HistoryFile& last, const std::function<void()>& meanwhile) {
  check_group_names(last.history);
  check_names(names_of(last.channels), "channel");
  append_columns(file_, last.history, last.channels);
  write_empty(file_, last.history, last.channels);
  write_groups(file_, last.history, last.channels);
  write_run(file_, last);
  file_.commit(meanwhile);
}

void write_history(const std::filesystem::path& path, const HistoryFile& file,
                   const std::function<void()>& meanwhile) {
  HistoryWriter(path).finish(file, meanwhile);
}

}  // namespace flexneck::multibody
