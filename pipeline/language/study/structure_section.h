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
#include "pipeline/language/study/neck_section.h"

namespace flexneck::pipeline {

/// Data of [geometry.materials.<name>] that are not part of the mesh.
struct MaterialModel {
  std::optional<fe_modal::Formulation> formulation;  ///< overrides that of [modes]
  double static_modulus_ratio = 1;  ///< Young's modulus in static tests over that of the modes
};
/// Models keyed by the materials' names.
using MaterialModels = std::map<std::string, MaterialModel>;

/// Content of [geometry] and [mesh]: a gmsh script, or a file.
struct StructureSection {
  std::variant<mesher::ScriptMeshOptions, mesher::ImportOptions> source;
  MaterialModels material_models;
  std::optional<NeckSection> neck;  ///< present if the script draws the neck

  const std::filesystem::path& file() const;
};

/// Volumes and masses of the neck in closed form. @pre structure.neck
geometry::NeckMeasures measure_neck(const StructureSection& structure);

/// Content of [matrices]: K and M in place of a mesh. The files' extensions determine their
/// formats.
struct MatricesSection {
  std::filesystem::path stiffness;  ///< (3n, 3n), N/m, without fixed degrees of freedom
  std::filesystem::path mass;       ///< (3n, 3n), kg, without fixed degrees of freedom
  std::filesystem::path nodes;      ///< (n, 3), m
};

/// Content of [[interface]]: a place where other bodies attach.
struct InterfaceSection {
  std::string name;
  std::string set;  ///< a face set, or a fixed set
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
};

}  // namespace flexneck::pipeline
