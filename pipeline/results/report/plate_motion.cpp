// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/results/report/plate_motion.h"

#include <algorithm>
#include <limits>

#include <Eigen/Geometry>

namespace flexneck::pipeline {

namespace {

using Eigen::Index;
using Eigen::Vector3d;

/// Heights between which a submesh deforms.
struct Rubber {
  double low_m = std::numeric_limits<double>::infinity();
  double high_m = -std::numeric_limits<double>::infinity();
};

bool holds(const PieceSection& piece, const std::string& part) {
  return std::find(piece.parts.begin(), piece.parts.end(), part) != piece.parts.end();
}

/// Range along z of the softest material of a submesh.
Rubber rubber_of(const PieceSection& piece, const mesher::Mesh& mesh) {
  Rubber rubber;
  double softest_Pa = std::numeric_limits<double>::infinity();
  for (const mesher::ElementBlock& block : mesh.blocks) {
    const double modulus_Pa = mesh.materials[block.material].youngs_modulus_Pa;
    if (!holds(piece, block.part) || modulus_Pa >= softest_Pa) continue;
    softest_Pa = modulus_Pa;
    rubber = {};
    for (const std::int32_t node : block.nodes) {
      const double z = mesh.nodes[static_cast<std::size_t>(node)][2];
      rubber.low_m = std::min(rubber.low_m, z);
      rubber.high_m = std::max(rubber.high_m, z);
    }
  }
  return rubber;
}

/// Plates and the vertices between them. Each submesh is made of parts: a vertex belongs to the two
/// markers of its submesh, and its height gives their weights.
Plates plates_at(std::vector<std::string> markers, const std::vector<PieceSection>& pieces,
                 const mesher::Mesh& mesh, const mesher::Surface& surface) {
  Plates plates{std::move(markers), {}, {}};
  std::vector<Rubber> rubbers;
  rubbers.reserve(pieces.size());
  for (const PieceSection& piece : pieces) rubbers.push_back(rubber_of(piece, mesh));
  const auto count = static_cast<Index>(surface.block_of_vertex.size());
  Eigen::VectorXd z(static_cast<Index>(mesh.nodes.size()));
  for (Index n = 0; n < z.size(); ++n) z[n] = mesh.nodes[static_cast<std::size_t>(n)][2];
  const Eigen::VectorXd heights = surface.value * z;
  plates.share.resize(count);
  for (Index v = 0; v < count; ++v) {
    const std::string& part =
        mesh.blocks[surface.block_of_vertex[static_cast<std::size_t>(v)]].part;
    const auto piece = std::find_if(pieces.begin(), pieces.end(),
                                    [&](const PieceSection& each) { return holds(each, part); });
    const auto section = static_cast<std::size_t>(piece - pieces.begin());
    const Rubber& rubber = rubbers[section];
    plates.section.push_back(static_cast<std::uint8_t>(section));
    plates.share[v] = static_cast<float>(
        std::clamp((heights[v] - rubber.low_m) / (rubber.high_m - rubber.low_m), 0.0, 1.0));
  }
  return plates;
}

/// True if every block of the mesh belongs to a submesh.
bool cover(const std::vector<PieceSection>& pieces, const mesher::Mesh& mesh) {
  return std::all_of(mesh.blocks.begin(), mesh.blocks.end(), [&](const auto& block) {
    return std::any_of(pieces.begin(), pieces.end(),
                       [&](const PieceSection& piece) { return holds(piece, block.part); });
  });
}

Eigen::Isometry3d pose_of(const multibody::History& history, const std::string& marker, Index k) {
  const multibody::MarkerHistory& found = history.marker(marker);
  const Eigen::Vector4d q = found.rotation.col(k);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
  pose.translation() = found.position_m.col(k);
  return pose;
}

}  // namespace

std::optional<Plates> plates_of(const Study& study, const CaseSection& experiment,
                                const mesher::Mesh& mesh, const mesher::Surface& surface) {
  const std::vector<PieceUse>& uses = experiment.model.of_pieces;
  const std::vector<PieceSection>& pieces = study.substructures.pieces;
  if (uses.empty() || uses.size() != pieces.size() || study.substructures.by_planes ||
      !cover(pieces, mesh))
    return {};
  const multibody::Model& model = experiment.model.model;
  std::vector<std::string> markers;
  for (std::size_t k = 0; k < uses.size(); ++k) {
    if (uses[k].piece != pieces[k].name) return {};
    const multibody::Section& section = model.forces.of<multibody::Section>()[uses[k].section];
    if (k == 0) markers.push_back(model.markers[section.marker_i].name);
    markers.push_back(model.markers[section.marker_j].name);
  }
  return plates_at(std::move(markers), pieces, mesh, surface);
}

std::optional<Plates> links_of(const Study& study, const mesher::Mesh& mesh,
                               const mesher::Surface& surface) {
  const std::vector<PieceSection>& pieces = study.substructures.pieces;
  if (pieces.empty() || study.substructures.by_planes || !cover(pieces, mesh)) return {};
  std::vector<std::string> markers = {"neck.base"};
  for (std::size_t k = 0; k + 1 < pieces.size(); ++k)
    markers.push_back(pieces[k].name + ".to_" + pieces[k + 1].name);
  markers.emplace_back("neck.top");
  return plates_at(std::move(markers), pieces, mesh, surface);
}

Eigen::MatrixXd plate_motion(const Plates& plates, const multibody::History& history) {
  const auto count = static_cast<Index>(plates.markers.size());
  Eigen::MatrixXd motion(12 * count, history.time_s.size());
  for (Index k = 0; k < motion.cols(); ++k) {
    const Eigen::Isometry3d to_base = pose_of(history, plates.markers.front(), k).inverse();
    const Eigen::Isometry3d to_base_first = pose_of(history, plates.markers.front(), 0).inverse();
    for (Index p = 0; p < count; ++p) {
      const std::string& marker = plates.markers[static_cast<std::size_t>(p)];
      const Eigen::Isometry3d now = to_base * pose_of(history, marker, k);
      const Eigen::Isometry3d first = to_base_first * pose_of(history, marker, 0);
      const Eigen::Isometry3d moved = now * first.inverse();
      const Eigen::Matrix3d rows = moved.linear().transpose();
      motion.col(k).segment<9>(12 * p) = Eigen::Map<const Eigen::Matrix<double, 9, 1>>(rows.data());
      motion.col(k).segment<3>(12 * p + 9) = moved.translation();
    }
  }
  return motion;
}

}  // namespace flexneck::pipeline
