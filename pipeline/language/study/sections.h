// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "pipeline/language/document/study_document.h"
#include "pipeline/language/model/assembly.h"
#include "pipeline/language/study/study.h"

namespace flexneck::pipeline {

/// The study's bodies and forces that a case uses, and its own tables of them.
struct CaseTables {
  /// Tables that may contain such tables, each overriding those before it.
  std::vector<StudyTable> layers;
  std::vector<std::string> bodies;  ///< names of the study's bodies; empty: all
  std::vector<std::string> forces;  ///< names of the study's forces; those in the layers always act
};

/// The tables of the model language in a study (model_sections.h): bodies, markers, joints, motors
/// and forces, from which each case makes a model.
class StudyModels {
 public:
  /// @param interfaces  names of the interfaces of the study's structure
  StudyModels(const StudyTable& root, std::vector<std::string> interfaces);

  /// All tables of the study itself, which need not form a model: joints of several cases may hold
  /// the same body.
  /// @param end_time_s  time that motions over time have to cover
  /// @param resolution_s  sampling interval of expressions of time
  Assembly whole(double end_time_s, double resolution_s) const;

  /// The model of a case from the study's tables and those of its layers: a table with a name of
  /// the study's replaces the keys that it gives, another one is added. Joints and markers are
  /// included with their bodies, motors with their joints.
  /// @param begun  settings of the case: the source of its prescribed bodies' motion, its duration
  /// @throws InputError naming file, line and key for an error in the tables.
  Assembly of_case(const CaseTables& experiment, Assembly begun) const;

 private:
  std::map<std::string, std::vector<StudyTable>> sections_;
  std::vector<std::string> interfaces_;
};

// Keys of the sections.
std::span<const Key> geometry_keys();
std::span<const Key> materials_keys();
std::span<const Key> mesh_keys();
std::span<const Key> matrices_keys();
std::span<const Key> interface_keys();
/// Keys of [modes], including those of its tables.
std::span<const Key> modes_keys();
/// Keys of [[modes.coupling]], [[modes.support]], …
std::span<const Key> modes_connection_keys();
std::span<const Key> load_keys();
std::span<const Key> pulse_keys();
std::span<const Key> case_keys();
std::span<const Key> variant_keys();
std::span<const Key> dummy_keys();
std::span<const Key> test_keys();

StructureSection read_structure(const StudyTable& geometry, const StudyTable& mesh);
MatricesSection read_matrices(const StudyTable& matrices);
InterfaceSection read_interface(const StudyTable& interface);
fe_modal::Load read_load(const StudyTable& load);
/// Reads the key slits. @throws InputError for an unknown state.
geometry::SlitState read_slit_state(const StudyTable& geometry);
/// Reads [geometry.materials].
MaterialModels read_materials(const StudyTable& geometry, std::vector<mesher::Material>& materials,
                              std::map<std::string, std::string>& material_of_part);
/// Reads the keys partitions and node_order of [mesh].
MeshOrders read_mesh_orders(const StudyTable& mesh);
/// Reads the key formulation. @throws InputError for an unknown formulation.
fe_modal::Formulation read_formulation(const StudyTable& table);
ModesSection read_modes(const StudyTable& modes);
ModesConnections read_modes_connections(const StudyTable& modes);
/// Reads a pulse: a CSV file by the key table, which is recorded by FilesRead, or times and
/// deceleration.
PulseSection read_pulse(const StudyTable& pulse);
/// Keys of the tables [[body]], [[marker]], … in a study.
std::vector<Key> model_table_keys();
/// Cases of a study whose models and tests are read and checked completely.
enum class CasesRead {
  all,
  chosen  ///< chosen by the key cases, if the whole study has been read before
};
/// Reads [[case]] over [pendulum] or [static], and the cases that [[variant]] makes of them.
std::vector<CaseSection> read_cases(const StudyTable& root, const StudyModels& models,
                                    CasesRead which);
/// Returns whether a name matches a pattern, which may end in a *.
bool fits(const std::string& name, const std::string& pattern);
/// Names of the cases that the key cases chooses, including base cases of variants; all without the
/// key. @throws InputError for a name that no case has.
std::set<std::string> chosen_cases(const StudyTable& root, const std::vector<CaseSection>& cases);
/// Removes from the study the cases not chosen, and their tests.
void select_cases(const StudyTable& root, Study& study);
/// Reads [dummy] and [[test]] for the cases that have been read.
/// @param known  tests of an earlier reading of the study, whose regulations are not read again
void read_tests(const StudyTable& root, const std::vector<TestSection>& known, CasesRead which,
                Study& study);
void read_solver(const StudyTable& solver, Study& study);

}  // namespace flexneck::pipeline
