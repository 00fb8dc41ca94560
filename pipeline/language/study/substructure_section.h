// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "fe_modal/body/basis_kind.h"
#include "pipeline/language/document/study_document.h"

namespace flexneck::pipeline {

/// Content of [[substructures.piece]]: a submesh made of parts, or of the structure between its
/// plane and the one before.
struct PieceSection {
  std::string name;
  std::vector<std::string> parts;
  /// Position of its plane along the normal, m; none for the last submesh.
  std::optional<double> up_to_m;
};

/// Content of [substructures]: submeshes into which the structure is cut.
struct SubstructuresSection {
  std::vector<PieceSection> pieces;  ///< none: the structure stays one body
  bool by_planes = false;
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  fe_modal::SlitMotions slit_motions = fe_modal::SlitMotions::none;  ///< for submeshes with slits
  /// Number of modes of each submesh with its ends fixed, besides the static shapes of the ends.
  int modes = 0;
};

std::span<const Key> substructures_keys();
SubstructuresSection read_substructures(const StudyTable& table);

}  // namespace flexneck::pipeline
