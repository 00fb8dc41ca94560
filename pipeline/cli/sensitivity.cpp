// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/cli/sensitivity.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "fe_modal/analysis/sensitivity.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/step_times.h"
#include "geometry/neck/neck_parameters.h"
#include "mesher/gmsh/script_mesher.h"
#include "mesher/mesh/bounding_box.h"
#include "mesher/mesh/mesh.h"
#include "mesher/mesh/node_velocity.h"
#include "pipeline/language/study/study.h"
#include "pipeline/process/console.h"
#include "pipeline/results/tables/sensitivity_tables.h"
#include "pipeline/run/make_mesh.h"

namespace flexneck::pipeline {

namespace {

/// A dimension without a derivative.
struct LeftOutParameter {
  std::string key;
  std::string why;
  bool is_choice = false;  ///< the dimension only selects nodes, so leaving it out needs no warning
};

/// Parameters of a study's structure by which there are derivatives.
struct StudyParameters {
  /// Parameters named by their keys: the neck's dimensions or the script's constants, then the
  /// constants of the materials.
  std::vector<fe_modal::DesignParameter> parameters;
  std::vector<LeftOutParameter> left_out;
  int script_runs = 0;
};

/// Step to either side, as a fraction of the dimension's value. gmsh places nodes to within some
/// 1e-11 m, an error that the quotient magnifies; for the neck's dimensions the largest relative
/// error of a velocity is 1e-6 for steps from 1e-3 to 1e-2.
constexpr double kStep = 2e-3;
/// Displacement of the nodes, over the size of the body, for a change of a parameter by its own
/// value, below which the parameter counts as moving no node.
constexpr double kStandstill = 1e-7;

/// A number from which the script builds its geometry.
struct Dimension {
  std::string key;
  std::string unit;         ///< "m", or "1" for a pure number
  double value = 0;         ///< in that unit
  double setting_unit = 1;  ///< value of a setting of 1: the script's own length unit, in m, or 1
  std::string suffix;       ///< unit appended to the setting: " m", or empty
};

/// True if a value is written as a number without a unit.
bool is_pure(const std::string& text) {
  return text.find_first_not_of("0123456789.+-eE_") == std::string::npos;
}

std::vector<Dimension> dimensions_of(const Study& study) {
  const auto* const script = std::get_if<mesher::ScriptMeshOptions>(&study.structure->source);
  std::vector<Dimension> all;
  if (script == nullptr) return all;
  if (const NeckSection* const neck = study.neck(); neck != nullptr) {
    for (const geometry::NeckDimension& each : geometry::neck_dimensions()) {
      all.push_back(
          {std::string("geometry.") + each.name, "m", neck->dimensions.*each.member, 1, " m"});
    }
    if (neck->slits.depth) all.push_back({"geometry.slit_depth", "1", *neck->slits.depth, 1, ""});
    return all;
  }
  for (const auto& [name, value] : script->constants) {
    const std::string key = "geometry.constants." + name;
    const auto written = std::find_if(study.parameters.begin(), study.parameters.end(),
                                      [&](const Parameter& each) { return each.key == key; });
    const bool is_length = written != study.parameters.end() && !is_pure(written->value);
    const double unit = is_length ? script->length_unit_m : 1;
    all.push_back({key, is_length ? "m" : "1", value * unit, unit, ""});
  }
  return all;
}

/// Meshes of a study for other values of one dimension.
class MovedMeshes {
 public:
  MovedMeshes(const Study& study, const mesher::Mesh& mesh, const Console& console, int& runs)
      : study_(study), mesh_(mesh), console_(console), runs_(runs) {}

  /// Mesh for each value; none where the study or the script refuses it or the topology differs.
  std::vector<std::optional<mesher::Mesh>> at(const Dimension& dimension,
                                              const std::vector<double>& values) {
    std::vector<std::optional<Study>> moved;
    moved.reserve(values.size());
    for (const double value : values) moved.push_back(study_at(dimension, value));
    std::vector<const Study*> readable;
    for (const auto& each : moved)
      if (each) readable.push_back(&*each);
    runs_ += static_cast<int>(readable.size());
    std::vector<MeshOutcome> outcomes = make_meshes(readable, console_);
    std::vector<std::optional<mesher::Mesh>> meshes(values.size());
    auto next = outcomes.begin();
    for (std::size_t k = 0; k < values.size(); ++k)
      if (moved[k]) meshes[k] = fitting(std::move(*next++));
    return meshes;
  }
  /// Reason of the first refusal; empty if no mesh was refused.
  const std::string& refusal() const { return refusal_; }

 private:
  std::optional<Study> study_at(const Dimension& dimension, double value) {
    std::vector<std::string> settings = study_.settings;
    settings.push_back(fmt::format("{}={:.17g}{}", dimension.key, value / dimension.setting_unit,
                                   dimension.suffix));
    try {
      return read_study(study_.file, settings);
    } catch (const InputError& error) {
      return refused(error.what());
    }
  }

  /// Returns the mesh if it has the same topology as the study's mesh.
  std::optional<mesher::Mesh> fitting(MeshOutcome outcome) {
    if (!outcome.mesh) return refused(outcome.refusal);
    try {
      mesher::require_same_topology(mesh_, *outcome.mesh);
      return std::move(outcome.mesh);
    } catch (const InputError& error) {
      return refused(error.what());
    }
  }

  std::nullopt_t refused(const std::string& why) {
    if (refusal_.empty()) refusal_ = why;
    return std::nullopt;
  }

  const Study& study_;
  const mesher::Mesh& mesh_;
  const Console& console_;
  int& runs_;
  std::string refusal_;
};

/// Node velocities by central differences; if there is no mesh on one side, as below zero or where
/// a number of divisions jumps, by two steps to the other side, which is also of second order.
Eigen::Matrix3Xd velocity_of(const Dimension& dimension, const mesher::Mesh& mesh,
                             MovedMeshes& moved) {
  const double size_m = mesher::bounding_box(mesh).extent_m().maxCoeff();
  const double step = kStep * (dimension.value != 0 ? std::abs(dimension.value) : size_m);
  const auto beside = moved.at(dimension, {dimension.value - step, dimension.value + step});
  const auto& below = beside[0];
  const auto& above = beside[1];
  if (below && above) return mesher::node_velocity(mesh, *below, *above, 2 * step);
  const double side = above ? step : -step;
  const auto& near = above ? above : below;
  const auto far = near ? moved.at(dimension, {dimension.value + 2 * side}).front() : std::nullopt;
  if (!far) throw InputError(moved.refusal());
  return 2 * mesher::node_velocity(mesh, mesh, *near, side) -
         mesher::node_velocity(mesh, mesh, *far, 2 * side);
}

/// True if the dimension is a constant of the script; choices of nodes are made after the script.
bool reaches_script(const Dimension& dimension, const Study& study) {
  if (study.neck() == nullptr) return true;
  const auto& script = std::get<mesher::ScriptMeshOptions>(study.structure->source);
  return script.constants.count(dimension.key.substr(dimension.key.find('.') + 1)) > 0;
}

void add_dimension(const Dimension& dimension, const Study& study, const mesher::Mesh& mesh,
                   const Console& console, StudyParameters& result) {
  const auto leave_out = [&](const std::string& why, bool is_choice = false) {
    result.left_out.push_back({dimension.key, why, is_choice});
  };
  if (!reaches_script(dimension, study)) {
    leave_out("it selects nodes of the mesh and does not move them", true);
    return;
  }
  try {
    MovedMeshes moved(study, mesh, console, result.script_runs);
    Eigen::Matrix3Xd velocity = velocity_of(dimension, mesh, moved);
    const double size_m = mesher::bounding_box(mesh).extent_m().maxCoeff();
    const double change_m = velocity.cwiseAbs().maxCoeff() *
                            (dimension.value != 0 ? std::abs(dimension.value) : size_m);
    if (!(change_m > kStandstill * size_m)) {
      leave_out(moved.refusal().empty() ? "it moves no node of the mesh" : moved.refusal());
      return;
    }
    result.parameters.push_back(
        {dimension.key, dimension.unit, dimension.value, std::move(velocity)});
  } catch (const InputError& error) {
    leave_out(error.what());
  }
}

/// Runs the script with each of its numbers a little lower and higher to find the velocities of the
/// nodes. Parameters that move no node, such as a choice of nodes, and those that change the
/// topology, such as a number of divisions, are left out. A mesh from a file has materials only.
/// @param mesh mesh of the study
StudyParameters design_parameters(const Study& study, const mesher::Mesh& mesh,
                                  const Console& console) {
  StudyParameters result;
  for (const Dimension& dimension : dimensions_of(study))
    add_dimension(dimension, study, mesh, console, result);
  if (std::holds_alternative<mesher::ImportOptions>(study.structure->source)) {
    result.left_out.push_back({study.structure->file().filename().string(),
                               "a mesh from a file has no dimensions, only materials", true});
  }
  for (std::size_t m = 0; m < mesh.materials.size(); ++m) {
    const mesher::Material& material = mesh.materials[m];
    const std::string key = "geometry.materials." + material.name + ".";
    using enum fe_modal::MaterialConstant;
    const auto add = [&](const char* name, const char* unit, double value,
                         fe_modal::MaterialConstant constant) {
      result.parameters.push_back(
          {key + name, unit, value, fe_modal::MaterialParameter{m, constant}});
    };
    add("youngs_modulus", "Pa", material.youngs_modulus_Pa, youngs_modulus);
    add("poissons_ratio", "1", material.poissons_ratio, poissons_ratio);
    add("density", "kg/m^3", material.density_kg_m3, density);
  }
  return result;
}

/// Prints the parameters left out, those that might have had a derivative as warnings.
void show_left_out(const Console& console, const std::vector<LeftOutParameter>& left_out) {
  for (const LeftOutParameter& each : left_out) {
    const std::string line = each.key + " is omitted: " + each.why;
    each.is_choice ? console.result(line) : console.warning("--sensitivity: " + line);
  }
}

}  // namespace

void check_sensitivity(const Study& study) {
  const auto refuse = [&](const std::string& problem) {
    throw InputError(study.file.string() + ": --sensitivity " + problem);
  };
  if (study.matrices) {
    refuse("needs a mesh, which [matrices] does not contain; remove the option");
  }
  if (study.modes.prestress) {
    refuse("is not supported for prestressed modes; remove modes.prestress");
  }
  if (study.modes.basis == fe_modal::BasisKind::craig_bampton) {
    refuse(
        "needs eigenvectors, found modes.basis = \"craig-bampton\"; use \"normal\" or "
        "\"residual\"");
  }
}

void write_sensitivities(const CommandInput& input, const mesher::Mesh& mesh,
                         const fe_modal::ModalOptions& options, const fe_modal::ModalBody& body,
                         const fe_modal::AnalysisFields& fields, Provenance provenance) {
  StepTimes times;
  input.console.step("Perturbing the mesh by each dimension");
  times.start("runs of the script");
  StudyParameters study = design_parameters(input.study, mesh, input.console);
  times.start("sensitivities");
  input.console.step(fmt::format("Computing sensitivities to {} inputs", study.parameters.size()));
  const fe_modal::Sensitivities found =
      fe_modal::sensitivities(mesh, options, body, fields, std::move(study.parameters));
  times.stop();
  input.console.detail()(
      fmt::format("seconds: {}; {} runs of the script", times.summary(), study.script_runs));
  std::vector<std::string> notes;
  for (const LeftOutParameter& each : study.left_out)
    notes.push_back("Omitted: " + each.key + ": " + each.why + ".");
  const std::vector<ResultTable> tables = sensitivity_tables(found, notes);
  const std::filesystem::path path = input.folder.sensitivities();
  provenance.inputs.push_back(
      {input.folder.modes().filename().string(), hash_of_file(input.folder.modes().string())});
  write_tables(path, tables, provenance);
  if (input.console.is_verbose()) {
    for (const ResultTable& table : tables)
      if (table.name != kSensitivityTable) input.console.table("\n" + printed(table));
  } else {
    input.console.result("\n" + short_sensitivities(found));
  }
  show_left_out(input.console, study.left_out);
  input.console.result("All sensitivities: " + path.string());
}

}  // namespace flexneck::pipeline
