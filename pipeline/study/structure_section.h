// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <variant>

#include <Eigen/Core>

#include "fe_modal/element/formulation.h"
#include "geometry/neck/neck_measures.h"
#include "mesher/exchange/import_options.h"
#include "mesher/gmsh/script_mesher.h"
#include "pipeline/study/neck_section.h"

namespace flexneck::pipeline {

/// What [geometry.materials.<name>] says beyond the mesh.
struct MaterialModel {
  std::optional<fe_modal::Formulation> formulation;  ///< in place of that of [modes]
  double static_modulus_ratio = 1;  ///< Young's modulus in static tests over that of the modes
};
/// By the materials' names.
using MaterialModels = std::map<std::string, MaterialModel>;

/// [geometry] and [mesh]: a gmsh script, or a file.
struct StructureSection {
  std::variant<mesher::ScriptMeshOptions, mesher::ImportOptions> source;
  MaterialModels material_models;
  std::optional<NeckSection> neck;  ///< of a script that draws it

  const std::filesystem::path& file() const;
};

/// Volumes and masses of the neck in closed form. @pre structure.neck
geometry::NeckMeasures measure_neck(const StructureSection& structure);

/// [matrices]: K and M in place of a mesh. The files' endings tell their formats.
struct MatricesSection {
  std::filesystem::path stiffness;  ///< (3n, 3n), N/m, without what is fixed
  std::filesystem::path mass;       ///< likewise, kg
  std::filesystem::path nodes;      ///< (n, 3), m
};

/// [[interface]]: where other bodies attach.
struct InterfaceSection {
  std::string name;
  std::string set;  ///< a face set, or a fixed set
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
};

}  // namespace flexneck::pipeline
