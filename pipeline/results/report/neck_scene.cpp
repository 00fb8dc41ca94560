// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/results/report/neck_scene.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "geometry/foundation/names.h"
#include "mesher/drawing/colours.h"
#include "mesher/drawing/outer_surface.h"
#include "pipeline/results/plotting/embedding.h"
#include "pipeline/results/report/head_shape.h"
#include "pipeline/results/report/neck_motions.h"

namespace flexneck::pipeline {

using Json = nlohmann::ordered_json;

namespace {

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
