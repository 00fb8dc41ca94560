// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "fe_modal/body/basis_kind.h"
#include "pipeline/document/study_document.h"

namespace flexneck::pipeline {

/// [[substructures.piece]]: made of parts, or of what lies below a plane and above the one before.
struct PieceSection {
  std::string name;
  std::vector<std::string> parts;
  std::optional<double> up_to_m;  ///< along the normal; none for the last piece
};

/// [substructures]: bodies that the structure is cut into.
struct SubstructuresSection {
  std::vector<PieceSection> pieces;  ///< none: the structure stays one body
  bool by_planes = false;
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  fe_modal::SlitMotions slit_motions = fe_modal::SlitMotions::none;  ///< where pieces have slits
  int modes = 0;  ///< of each piece with its ends fixed, besides the static shapes of the ends
};

std::span<const Key> substructures_keys();
SubstructuresSection read_substructures(const StudyTable& table);

}  // namespace flexneck::pipeline
