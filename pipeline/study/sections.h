// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <set>
#include <span>
#include <string>
#include <vector>

#include "pipeline/document/study_document.h"
#include "pipeline/study/case_tables.h"
#include "pipeline/study/study.h"

namespace flexneck::pipeline {

// What the sections may say.
std::span<const Key> geometry_keys();
std::span<const Key> materials_keys();
std::span<const Key> mesh_keys();
std::span<const Key> matrices_keys();
std::span<const Key> interface_keys();
/// [modes], with those of its tables.
std::span<const Key> modes_keys();
/// [[modes.coupling]], [[modes.support]], …
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
/// The key slits. @throws InputError if there is none of that name.
geometry::SlitState read_slit_state(const StudyTable& geometry);
/// [geometry.materials]
MaterialModels read_materials(const StudyTable& geometry, std::vector<mesher::Material>& materials,
                              std::map<std::string, std::string>& material_of_part);
/// The keys partitions and node_order of [mesh].
MeshOrders read_mesh_orders(const StudyTable& mesh);
/// The key formulation. @throws InputError if there is none of that name.
fe_modal::Formulation read_formulation(const StudyTable& table);
ModesSection read_modes(const StudyTable& modes);
ModesConnections read_modes_connections(const StudyTable& modes);
/// The keys table, a CSV file, or times and deceleration. A file read is appended to `files`.
PulseSection read_pulse(const StudyTable& pulse);
/// The tables [[body]], [[marker]], … as a study has them.
std::vector<Key> model_table_keys();
/// Which cases of a study get their models and are checked whole, with the tests that judge them.
enum class CasesRead {
  all,
  chosen  ///< by the key cases: for what has been read whole before
};
/// [[case]] over [pendulum] or [static], and the cases that [[variant]] makes of them.
std::vector<CaseSection> read_cases(const StudyTable& root, const StudyModels& models,
                                    CasesRead which);
/// Whether a name is that of a pattern, whose end may be a *.
bool fits(const std::string& name, const std::string& pattern);
/// Names of the cases that the key cases chooses, with those that variants are made of; all without
/// the key. @throws InputError for a name that no case has.
std::set<std::string> chosen_cases(const StudyTable& root, const std::vector<CaseSection>& cases);
/// Leaves the study the cases chosen, and the tests that judge them.
void select_cases(const StudyTable& root, Study& study);
/// [dummy] and [[test]] of the cases that have been read.
/// @param known  tests of an earlier reading of the study, whose regulations are not read again
void read_tests(const StudyTable& root, const std::vector<TestSection>& known, CasesRead which,
                Study& study);
void read_solver(const StudyTable& solver, Study& study);

}  // namespace flexneck::pipeline
