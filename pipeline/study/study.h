// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "fe_modal/body/basis_kind.h"
#include "fe_modal/element/formulation.h"
#include "fe_modal/system/loads.h"
#include "fe_modal/system/solver.h"
#include "geometry/foundation/files_read.h"
#include "geometry/foundation/provenance.h"
#include "geometry/foundation/units.h"
#include "multibody/model/model.h"
#include "multibody/simulation/simulation.h"
#include "pipeline/document/key.h"
#include "pipeline/model/assembly.h"
#include "pipeline/model/pulse.h"
#include "pipeline/study/measured_section.h"
#include "pipeline/study/modes_connections.h"
#include "pipeline/study/structure_section.h"
#include "pipeline/study/substructure_section.h"
#include "pipeline/verdict/certification_test.h"

namespace flexneck::pipeline {

/// [mesh]: what is stored with the mesh for those who solve on it.
struct MeshOrders {
  std::vector<int> partitions;  ///< numbers of processes to share the elements out to
  bool node_order = false;      ///< an order of elimination by nested dissection
};

/// [modes]
struct ModesSection {
  int count = 10;
  fe_modal::Formulation formulation = fe_modal::Formulation::mixed_pressure;
  fe_modal::Solver solver = fe_modal::Solver::automatic;
  std::string petsc_options;  ///< of PETSc and SLEPc
  fe_modal::BasisKind basis = fe_modal::BasisKind::normal;
  fe_modal::SlitMotions slit_motions = fe_modal::SlitMotions::none;
  bool prestress = false;                     ///< about the stresses of the study's loads
  bool stress_stiffening = false;             ///< geometric stiffness of the modes under unit loads
  std::vector<std::string> rigid_interfaces;  ///< whose nodes are tied to move rigidly
  std::vector<std::string> basis_interfaces;  ///< whose static shapes join the basis; empty: all
  bool check = false;  ///< check that no mode is missing, estimate the error of the mesh
  std::vector<std::string> fixed;  ///< node sets fixed in all directions
  std::map<std::string, std::array<bool, 3>> fixed_directions;  ///< others, in some of x, y, z
  bool deck_supports = true;             ///< supports that the structure's file gives hold
  ModesConnections connections;          ///< couplings, supports, equations, springs, masses
  std::vector<std::string> rigid_parts;  ///< parts whose motion names the modes
  std::string attached_body;  ///< rigid body set on an interface for the loaded frequencies
  std::string attached_to;    ///< that interface; empty: the first
};

/// [[pulse]]: a deceleration; a case brings it to its impact velocity.
struct PulseSection {
  std::string name;
  std::vector<double> times_s;  ///< from 0 or later on, strictly increasing
  std::vector<double> deceleration_m_s2;
};

/// [[case]]: one experiment on a model of its own: the bodies that it takes of the study's, the
/// joints between them, and what it adds or changes in the same language. Keys that all experiments
/// of a kind share stand in [pendulum] and [static]; a [[variant]] makes cases of other ones.
struct CaseSection {
  enum class Kind { pendulum, static_test };
  enum class Direction { flexion, extension, lateral, oblique };
  enum class Arm { translating, rotating };
  std::string name;
  std::string variant_of;  ///< the case that a [[variant]] made this of; empty for none
  std::string variant;     ///< what that variant adds to its name
  std::string made_by;     ///< name of that variant
  Assembly model;  ///< its bodies not placed yet, those of the structure without their modes
  std::vector<std::string> forces;  ///< of the study's that act in it
  double duration_s = 1.0;
  double oblique_angle_rad = 0;  ///< of an oblique direction, from forwards towards the left
  // Of a pendulum:
  std::optional<double> drop_angle_rad;
  std::optional<double> effective_length_m;  ///< of the pendulum as one of a point
  double impact_velocity_m_s = 0;
  std::string pulse;
  double pivot_distance_m = 0;          ///< rotating: from the arm's pivot to the neck's base
  double accelerometer_distance_m = 0;  ///< rotating: to where velocity and pulse are measured
  MomentDefinition moment;              ///< of the virtual load cell
  Kind kind = Kind::pendulum;
  Direction direction = Direction::flexion;
  PulseFit pulse_scaling = PulseFit::amplitude;
  Arm arm = Arm::translating;
  bool velocity_is_given = true;       ///< otherwise it follows from angle and length
  bool equivalent_rigid_neck = false;  ///< in place of the deformable one
};

/// [[test]]: a case that is judged by a test of a regulation.
struct TestSection {
  std::string name;
  std::string experiment;  ///< the case
  CertificationTest rules;
  std::filesystem::path file;   ///< that the rules stand in
  std::vector<FileRead> reads;  ///< it and others
};

/// The table of keys of study files, by section.
std::span<const Key> study_keys();

/// Everything that a study file says, checked and in SI units.
struct Study {
  std::filesystem::path file;
  std::vector<std::string> settings;          ///< in place of the file's values: key=value
  std::optional<StructureSection> structure;  ///< what is meshed, or …
  std::optional<MatricesSection> matrices;    ///< … matrices from elsewhere
  std::vector<InterfaceSection> interfaces;
  std::vector<fe_modal::Load> loads;  ///< of a linear static step
  MeshOrders mesh_orders;
  ModesSection modes;
  SubstructuresSection substructures;
  Assembly model;  ///< all bodies, joints and forces of which the cases make theirs
  std::vector<PulseSection> pulses;
  std::vector<CaseSection> cases;  ///< variants after those they are made of
  std::string dummy;               ///< whose head and neck it is; empty if the study does not say
  std::vector<TestSection> tests;  ///< in the order in which they are shown
  std::vector<MeasuredTest> measured;  ///< tests with data of the user's own
  Eigen::Vector3d gravity_m_s2{0, 0, -kStandardGravity_m_s2};  ///< of pendulum cases, world
  multibody::SolverOptions solver;
  double output_interval_s = 1e-3;
  std::filesystem::path verification;  ///< table of reference figures; empty for none

  std::vector<InputFile> files;   ///< of the study itself
  std::vector<InputFile> tables;  ///< others read for experiments: CSV files, bodies, …
  std::vector<InputFile> rules;   ///< and for tests: regulations, measured curves
  std::vector<Parameter> parameters;
  std::vector<std::string> warnings;  ///< of names of earlier versions
  std::vector<Parameter> defaults;    ///< what holds for keys that the study does not give

  /// @throws InputError if there is no such body, or if it is not rigid.
  const multibody::RigidBody& rigid_body(const std::string& name) const;
  const MaterialModels& material_models() const;
  /// What is known of the neck; null if the structure is another one.
  const NeckSection* neck() const;
  /// True if a material has another modulus in static tests than in the modes.
  bool has_static_moduli() const;
};

/// @throws InputError with file, line, column and key for everything that is not right.
Study read_study(const std::filesystem::path& path, const std::vector<std::string>& settings);

/// The Hybrid III study that runs when none is named.
std::filesystem::path built_in_study();
/// Its certification test.
std::filesystem::path built_in_qualification();

}  // namespace flexneck::pipeline
