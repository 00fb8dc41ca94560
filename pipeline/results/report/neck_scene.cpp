// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/results/report/neck_scene.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <nlohmann/json_fwd.hpp>

#include "geometry/foundation/names.h"
#include "mesher/drawing/colours.h"
#include "mesher/drawing/outer_surface.h"
#include "pipeline/results/plotting/embedding.h"
#include "pipeline/results/report/head_shape.h"
#include "pipeline/results/report/plate_motion.h"
#include "pipeline/results/report/results.h"

namespace flexneck::pipeline {

namespace {

using Eigen::Index;
using Json = nlohmann::ordered_json;

/// A run with its case and sampling.
struct Run {
  const Experiment& experiment;
  const CaseSection* section;  ///< case in the study; null if it is not there
  Index stride;                ///< stride of the times shown

  const multibody::History& history() const { return experiment.file.history; }
  const multibody::MarkerHistory* marker(const std::string& name) const {
    const auto& markers = history().markers;
    const auto found = std::find_if(markers.begin(), markers.end(),
                                    [&](const auto& each) { return each.name == name; });
    return found == markers.end() ? nullptr : &*found;
  }
  /// Columns of every n-th time, the first and the last included.
  Eigen::MatrixXd shown(const Eigen::MatrixXd& columns) const {
    std::vector<Index> times;
    for (Index k = 0; k < columns.cols() - 1; k += stride) times.push_back(k);
    times.push_back(columns.cols() - 1);
    return columns(Eigen::all, times);
  }
  /// Poses of a marker as base64: position and quaternion (w, x, y, z), seven numbers a frame.
  std::string poses(const multibody::MarkerHistory& marker) const {
    Eigen::MatrixXd poses(7, marker.position_m.cols());
    poses << marker.position_m, marker.rotation;
    return base64_floats(shown(poses));
  }
};

/// The case of the study that a run belongs to, also if the run is of a chain of submeshes.
const CaseSection* section_of(const Study& study, const std::string& name) {
  const auto found = std::find_if(study.cases.begin(), study.cases.end(), [&](const auto& each) {
    return each.name == name || each.name + "-chain" == name;
  });
  return found == study.cases.end() ? nullptr : &*found;
}

/// The model's forces: name, and for each frame the point of application and the components, N.
Json loads_json(const Run& run) {
  Json loads = Json::array();
  if (run.section == nullptr) return loads;
  const multibody::Model& model = run.section->model.model;
  const Eigen::VectorXd& time_s = run.history().time_s;
  for (const multibody::PointForce& force : model.forces.of<multibody::PointForce>()) {
    const auto* const marker = run.marker(model.markers[force.marker].name);
    if (marker == nullptr) continue;
    Eigen::MatrixXd rows(6, time_s.size());
    rows.topRows<3>() = marker->position_m;
    for (Index k = 0; k < rows.cols(); ++k)
      rows.col(k).tail<3>() = force.magnitude_N.value(time_s[k]) * force.direction;
    loads.push_back({{"name", force.name}, {"rows", base64_floats(run.shown(rows))}});
  }
  return loads;
}

/// Data common to all motions; `base` gives the pose of the mesh's frame, and of the arm unless
/// that is given separately.
Json shared_json(const Run& run, const multibody::MarkerHistory& base) {
  const bool is_pendulum = run.experiment.kind == Experiment::Kind::pendulum;
  Json motion = {{"name", run.experiment.name},
                 {"kind", is_pendulum ? "pendulum" : "static"},
                 {"times", base64_floats(run.shown(run.history().time_s.transpose()))},
                 {"base", run.poses(base)}};
  const auto* const head = run.marker("head.condyles");
  if (head != nullptr) motion["head"] = run.poses(*head);
  Json loads = loads_json(run);
  if (!loads.empty()) motion["loads"] = std::move(loads);
  return motion;
}

Json plates_json(const Run& run, const std::optional<Plates>& plates) {
  if (!plates || !std::all_of(plates->markers.begin(), plates->markers.end(),
                              [&](const std::string& name) { return run.marker(name); }))
    return nullptr;
  Json motion = shared_json(run, *run.marker(plates->markers.front()));
  motion["plates"] = base64_floats(run.shown(plate_motion(*plates, run.history())));
  motion["sections"] = base64_of(plates->section);
  motion["shares"] = base64_floats(plates->share.cast<double>().transpose());
  return motion;
}

/// Indices of the run's modes among the body's; none if one is missing.
std::optional<std::vector<Index>> places_of(const multibody::ModalHistory& modal,
                                            const fe_modal::ModalBody& body) {
  const std::vector<std::string> names = names_of(body.modes);
  std::vector<Index> places;
  for (const std::string& mode : modal.modes) {
    const auto found = std::find(names.begin(), names.end(), mode);
    if (found == names.end()) return {};
    places.push_back(found - names.begin());
  }
  return places;
}

/// Motion of the neck as one deformable body; null if these modes do not describe it.
Json modal_json(const Run& run, const fe_modal::ModalBody& body) {
  const auto* const base = run.marker("neck.base");
  const std::vector<multibody::ModalHistory>& modal = run.history().modal;
  if (base == nullptr || modal.size() != 1 || modal.front().body != "neck") return nullptr;
  const auto places = places_of(modal.front(), body);
  if (!places) return nullptr;
  Json motion = shared_json(run, *base);
  motion["modes"] = *places;
  motion["coordinates"] = base64_floats(run.shown(modal.front().coordinates));
  return motion;
}

bool has_rigid_neck(const CaseSection& section) {
  const std::vector<multibody::Body>& bodies = section.model.model.bodies;
  return section.equivalent_rigid_neck ||
         std::any_of(bodies.begin(), bodies.end(), [](const multibody::Body& body) {
           return body.name == "neck" && std::holds_alternative<multibody::RigidBody>(body.kind);
         });
}

/// Motion of a rigid neck, drawn with the undeformed mesh: its top is that of the mesh.
Json rigid_json(const Run& run, const fe_modal::ModalBody& body) {
  const auto* const top = run.marker("neck.top");
  const auto interface = std::find_if(body.interfaces.begin(), body.interfaces.end(),
                                      [](const auto& each) { return each.name == "top"; });
  if (top == nullptr || run.section == nullptr || !has_rigid_neck(*run.section) ||
      interface == body.interfaces.end())
    return nullptr;
  multibody::MarkerHistory base = *top;
  for (Index k = 0; k < base.position_m.cols(); ++k) {
    const Eigen::Vector4d q = top->rotation.col(k);
    base.position_m.col(k) -= Eigen::Quaterniond(q[0], q[1], q[2], q[3]) * interface->position_m;
  }
  Json motion = shared_json(run, base);
  const auto* const arm = run.marker("arm.end");
  if (arm != nullptr) motion["arm"] = run.poses(*arm);
  motion["modes"] = Json::array();
  motion["coordinates"] = "";
  return motion;
}

/// Motions of neck, head, arm and loads in each run, in the form that page/body.js reads: the neck
/// by its modes, as a rigid body, or as plates with an interpolated surface between them (submeshes
/// as sections, and a chain of bodies). Runs of other models are left out.
/// @param most_frames  maximum number of frames of a run
/// @pre mesh and modes exist and belong together
Json motions_of(const Results& results, const Study& study, const mesher::Surface& surface,
                Index most_frames) {
  const fe_modal::ModalBody& body = *results.modes;
  Json motions = Json::array();
  for (const Experiment& experiment : results.experiments) {
    const Index times = experiment.file.history.time_s.size();
    if (times < 2) continue;
    const Run run{experiment, section_of(study, experiment.name),
                  (times + most_frames - 1) / most_frames};
    Json motion = modal_json(run, body);
    if (motion.is_null() && run.section != nullptr)
      motion = plates_json(run, plates_of(study, *run.section, *results.mesh, surface));
    if (motion.is_null()) motion = plates_json(run, links_of(study, *results.mesh, surface));
    if (motion.is_null()) motion = rigid_json(run, body);
    if (!motion.is_null()) motions.push_back(std::move(motion));
  }
  return motions;
}

constexpr std::size_t kMaxTriangles = 10'000;

using Chains = std::vector<std::vector<std::int32_t>>;

/// Chains of vertices as pairs, one pair for each line.
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

/// A shape with 16 bits for each component: its largest is 32767 times `scale`.
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

Json head_json(const Study& study) {
  const std::optional<HeadShape> head = head_shape(study);
  if (!head) return nullptr;
  const Eigen::Quaterniond& q = head->rotation;
  return {{"centre", std::vector<double>(head->centre_m.begin(), head->centre_m.end())},
          {"semiAxes", std::vector<double>(head->semi_axes_m.begin(), head->semi_axes_m.end())},
          {"rotation", {q.w(), q.x(), q.y(), q.z()}}};
}

}  // namespace

Json scene_of(const Results& results, const Study& study, Eigen::Index most_frames) {
  if (!results.mesh || !results.modes || results.modes->modes.empty()) return nullptr;
  const fe_modal::ModalBody& body = *results.modes;
  if (body.nodes_m.cols() != static_cast<Eigen::Index>(results.mesh->nodes.size())) return nullptr;
  const mesher::Surface surface = mesher::surface_of(*results.mesh, kMaxTriangles);
  Json scale = Json::array();
  for (const std::uint32_t colour : mesher::kColourScale)
    scale.push_back(fmt::format("#{:06x}", colour));
  return {{"surface", surface_json(*results.mesh, surface, body.nodes_m)},
          {"modes", modes_json(surface, body)},
          {"motions", motions_of(results, study, surface, most_frames)},
          {"shown", study.tests.empty() ? "" : study.tests.front().experiment},
          {"scale", std::move(scale)},
          {"head", head_json(study)}};
}

}  // namespace flexneck::pipeline
