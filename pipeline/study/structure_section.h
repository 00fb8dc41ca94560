// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <variant>

#include <Eigen/Core>

#include "mesher/exchange/mesh_import.h"
#include "mesher/script_mesher.h"

namespace flexneck::pipeline {

/// [geometry] and [mesh] of a structure that is not the neck: a gmsh script, or a file.
struct StructureSection {
  std::variant<mesher::ScriptMeshOptions, mesher::ImportOptions> source;

  const std::filesystem::path& file() const;
};

/// [[interface]]: where other bodies attach.
struct InterfaceSection {
  std::string name;
  std::string set;  ///< a face set, or a held set
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
};

}  // namespace flexneck::pipeline
