// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/report/neck_scene.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "geometry/foundation/names.h"
#include "mesher/drawing/colours.h"
#include "mesher/drawing/outer_surface.h"
#include "pipeline/plotting/embedding.h"
#include "pipeline/report/head_shape.h"
#include "pipeline/report/plate_motion.h"

namespace flexneck::pipeline {

using Json = nlohmann::ordered_json;

namespace {

constexpr std::size_t kMaxTriangles = 10'000;
/// Of a motion: more than a screen shows at a tenth of the real speed.
constexpr Eigen::Index kMaxFrames = 400;

using Chains = std::vector<std::vector<std::int32_t>>;

/// Chains of vertices as pairs, a line each.
std::vector<std::uint32_t> segments_of(const Chains& chains) {
  std::vector<std::uint32_t> pairs;
  for (const auto& chain : chains) {
    for (std::size_t i = 1; i < chain.size(); ++i) {
      pairs.push_back(static_cast<std::uint32_t>(chain[i - 1]));
      pairs.push_back(static_cast<std::uint32_t>(chain[i]));
    }
  }
  return pairs;
}

Json surface_json(const mesher::Mesh& mesh, const mesher::Surface& surface,
                  const Eigen::Matrix3Xd& nodes_m) {
  std::vector<std::uint32_t> triangles;
  for (const auto& triangle : surface.triangles) {
    triangles.insert(triangles.end(), triangle.begin(), triangle.end());
  }
  std::vector<std::uint8_t> materials;
  for (const std::size_t block : surface.block_of_vertex) {
    materials.push_back(static_cast<std::uint8_t>(mesh.blocks[block].material));
  }
  const Eigen::MatrixX3d positions = surface.value * nodes_m.transpose();
  return {{"positions", base64_floats(positions.transpose())},
          {"triangles", base64_of(triangles)},
          {"materials", base64_of(materials)},
          {"materialNames", names_of(mesh.materials)},
          {"edges", base64_of(segments_of(surface.edges))},
          {"outlines", base64_of(segments_of(surface.outlines))}};
}

/// A shape in 16 bits for each component: its largest is 32767 times `scale`.
Json shape_json(const mesher::Surface& surface, const Eigen::Matrix3Xd& shape) {
  const Eigen::MatrixX3d values = surface.value * shape.transpose();
  constexpr double kMost = std::numeric_limits<std::int16_t>::max();
  const double scale = std::max(values.cwiseAbs().maxCoeff(), 1e-300) / kMost;
  std::vector<std::int16_t> shorts;
  for (const double value : values.transpose().reshaped()) {
    shorts.push_back(static_cast<std::int16_t>(std::lround(value / scale)));
  }
  return {{"scale", scale}, {"values", base64_of(shorts)}};
}

Json modes_json(const mesher::Surface& surface, const fe_modal::ModalBody& body) {
  Json modes = Json::array();
  for (std::size_t k = 0; k < body.modes.size(); ++k) {
    modes.push_back({{"name", body.modes[k].name},
                     {"kind", body.modes[k].kind},
                     {"frequencyHz", body.frequencies_Hz[static_cast<Eigen::Index>(k)]},
                     {"shape", shape_json(surface, body.shapes[k])}});
  }
  return modes;
}

const multibody::MarkerHistory* marker_of(const multibody::History& history,
                                          const std::string& name) {
  const auto found = std::find_if(history.markers.begin(), history.markers.end(),
                                  [&](const auto& marker) { return marker.name == name; });
  return found == history.markers.end() ? nullptr : &*found;
}

/// Every so many-th time, the first and the last included.
Eigen::MatrixXd every(const Eigen::MatrixXd& columns, Eigen::Index stride) {
  std::vector<Eigen::Index> times;
  for (Eigen::Index k = 0; k < columns.cols() - 1; k += stride) times.push_back(k);
  times.push_back(columns.cols() - 1);
  return columns(Eigen::all, times);
}

/// Position and quaternion (w, x, y, z) of a marker, seven numbers a frame.
std::string poses_of(const multibody::MarkerHistory& marker, Eigen::Index stride) {
  Eigen::MatrixXd poses(7, marker.position_m.cols());
  poses << marker.position_m, marker.rotation;
  return base64_floats(every(poses, stride));
}

/// Places of the run's modes among the body's; none if one of them is not there.
std::optional<std::vector<Eigen::Index>> places_of(const multibody::ModalHistory& modal,
                                                   const fe_modal::ModalBody& body) {
  const std::vector<std::string> names = names_of(body.modes);
  std::vector<Eigen::Index> places;
  for (const std::string& mode : modal.modes) {
    const auto found = std::find(names.begin(), names.end(), mode);
    if (found == names.end()) return {};
    places.push_back(found - names.begin());
  }
  return places;
}

/// What all motions have.
Json shared_json(const Experiment& experiment, const multibody::MarkerHistory& base,
                 Eigen::Index stride) {
  const multibody::History& history = experiment.file.history;
  const bool is_pendulum = experiment.kind == Experiment::Kind::pendulum;
  Json motion = {{"name", experiment.name},
                 {"kind", is_pendulum ? "pendulum" : "static"},
                 {"times", base64_floats(every(history.time_s.transpose(), stride))},
                 {"base", poses_of(base, stride)}};
  const multibody::MarkerHistory* const head = marker_of(history, "head.condyles");
  if (head != nullptr) motion["head"] = poses_of(*head, stride);
  return motion;
}

Eigen::Index stride_of(const multibody::History& history) {
  return (history.time_s.size() + kMaxFrames - 1) / kMaxFrames;
}

/// A run of the neck as plates and sections; null for any other.
Json plates_json(const Experiment& experiment, const Study& study, const mesher::Mesh& mesh,
                 const mesher::Surface& surface) {
  const multibody::History& history = experiment.file.history;
  const auto section = std::find_if(study.cases.begin(), study.cases.end(),
                                    [&](const auto& each) { return each.name == experiment.name; });
  if (section == study.cases.end() || history.time_s.size() < 2) return nullptr;
  const std::optional<Plates> plates = plates_of(study, *section, mesh, surface);
  if (!plates || !std::all_of(plates->markers.begin(), plates->markers.end(),
                              [&](const std::string& name) { return marker_of(history, name); }))
    return nullptr;
  const Eigen::Index stride = stride_of(history);
  Json motion = shared_json(experiment, *marker_of(history, plates->markers.front()), stride);
  motion["plates"] = base64_floats(every(plate_motion(*plates, history), stride));
  motion["sections"] = base64_of(plates->section);
  motion["shares"] = base64_floats(plates->share.cast<double>().transpose());
  return motion;
}

/// A run of the neck as one body; null for one whose motion these modes do not tell.
Json motion_json(const Experiment& experiment, const fe_modal::ModalBody& body) {
  const multibody::History& history = experiment.file.history;
  const multibody::MarkerHistory* const base = marker_of(history, "neck.base");
  if (base == nullptr || history.time_s.size() < 2) return nullptr;
  const auto modal =
      std::find_if(history.modal.begin(), history.modal.end(),
                   [](const multibody::ModalHistory& each) { return each.body == "neck"; });
  if (modal == history.modal.end() || history.modal.size() != 1) return nullptr;
  const auto places = places_of(*modal, body);
  if (!places) return nullptr;

  const Eigen::Index stride = stride_of(history);
  Json motion = shared_json(experiment, *base, stride);
  motion["modes"] = *places;
  motion["coordinates"] = base64_floats(every(modal->coordinates, stride));
  return motion;
}

Json head_json(const Study& study) {
  const std::optional<HeadShape> head = head_shape(study);
  if (!head) return nullptr;
  const Eigen::Quaterniond& q = head->rotation;
  return {{"centre", std::vector<double>(head->centre_m.begin(), head->centre_m.end())},
          {"semiAxes", std::vector<double>(head->semi_axes_m.begin(), head->semi_axes_m.end())},
          {"rotation", {q.w(), q.x(), q.y(), q.z()}}};
}

}  // namespace

Json scene_of(const Results& results, const Study& study) {
  if (!results.mesh || !results.modes || results.modes->modes.empty()) return nullptr;
  const fe_modal::ModalBody& body = *results.modes;
  if (body.nodes_m.cols() != static_cast<Eigen::Index>(results.mesh->nodes.size())) return nullptr;
  const mesher::Surface surface = mesher::surface_of(*results.mesh, kMaxTriangles);
  Json scale = Json::array();
  for (const std::uint32_t colour : mesher::kColourScale)
    scale.push_back(fmt::format("#{:06x}", colour));
  Json motions = Json::array();
  for (const Experiment& experiment : results.experiments) {
    Json motion = motion_json(experiment, body);
    if (motion.is_null()) motion = plates_json(experiment, study, *results.mesh, surface);
    if (!motion.is_null()) motions.push_back(std::move(motion));
  }
  return {{"surface", surface_json(*results.mesh, surface, body.nodes_m)},
          {"modes", modes_json(surface, body)},
          {"motions", std::move(motions)},
          {"scale", std::move(scale)},
          {"head", head_json(study)}};
}

}  // namespace flexneck::pipeline
