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
#include "pipeline/laboratory/verdict/certification_test.h"
#include "pipeline/language/document/key.h"
#include "pipeline/language/model/assembly.h"
#include "pipeline/language/model/pulse.h"
#include "pipeline/language/study/measured_section.h"
#include "pipeline/language/study/modes_connections.h"
#include "pipeline/language/study/structure_section.h"
#include "pipeline/language/study/substructure_section.h"

namespace flexneck::pipeline {

/// Content of [mesh] that is stored with the mesh for its analysis.
struct MeshOrders {
  std::vector<int> partitions;  ///< numbers of processes for which the elements are partitioned
  bool node_order = false;      ///< an order of elimination by nested dissection
};

/// Content of [modes].
struct ModesSection {
  int count = 10;
  fe_modal::Formulation formulation = fe_modal::Formulation::mixed_pressure;
  fe_modal::Solver solver = fe_modal::Solver::automatic;
  std::string petsc_options;  ///< options for PETSc and SLEPc
  fe_modal::BasisKind basis = fe_modal::BasisKind::normal;
  fe_modal::SlitMotions slit_motions = fe_modal::SlitMotions::none;
  bool prestress = false;  ///< true if the modes are about the stresses of the study's loads
  bool stress_stiffening = false;             ///< geometric stiffness of the modes under unit loads
  std::vector<std::string> rigid_interfaces;  ///< interfaces whose nodes are coupled rigidly
  /// Interfaces whose static shapes join the basis; empty: all.
  std::vector<std::string> basis_interfaces;
  bool check = false;  ///< check that no mode is missing, estimate the error of the mesh
  std::vector<std::string> fixed;  ///< node sets fixed in all directions
  /// Node sets fixed in some of x, y, z.
  std::map<std::string, std::array<bool, 3>> fixed_directions;
  bool deck_supports = true;             ///< true if supports in the structure's file apply
  ModesConnections connections;          ///< couplings, supports, equations, springs, masses
  std::vector<std::string> rigid_parts;  ///< parts whose motion names the modes
  std::string attached_body;  ///< rigid body set on an interface for the loaded frequencies
  std::string attached_to;    ///< name of that interface; empty: the first
};

/// Content of [[pulse]]: a deceleration, which a case scales to its impact velocity.
struct PulseSection {
  std::string name;
  std::vector<double> times_s;  ///< first at or above 0, strictly increasing
  std::vector<double> deceleration_m_s2;
};

/// Content of [[case]]: one experiment on a model of its own: the study's bodies that it uses, the
/// joints between them, and its additions and changes in the same language. Keys shared by all
/// experiments of a kind are in [pendulum] and [static]; a [[variant]] makes cases from other
/// cases.
struct CaseSection {
  enum class Kind { pendulum, static_test };
  enum class Direction { flexion, extension, lateral, oblique };
  enum class Arm { translating, rotating };
  std::string name;
  std::string variant_of;  ///< base case of a [[variant]]; empty for none
  std::string variant;     ///< suffix that the variant adds to its name
  std::string made_by;     ///< name of that variant
  Assembly model;  ///< its bodies not placed yet, those of the structure without their modes
  std::vector<std::string> forces;  ///< names of the study's forces that act in it
  double duration_s = 1.0;
  double oblique_angle_rad = 0;  ///< for an oblique direction, from forwards towards the left
  // Data of a pendulum:
  std::optional<double> drop_angle_rad;
  std::optional<double> effective_length_m;  ///< length of the equivalent point pendulum
  double impact_velocity_m_s = 0;
  std::string pulse;
  double pivot_distance_m = 0;  ///< rotating arm: distance from its pivot to the neck's base
  /// Rotating arm: distance from its pivot to the point of velocity and pulse.
  double accelerometer_distance_m = 0;
  MomentDefinition moment;  ///< moment of the virtual load cell
  Kind kind = Kind::pendulum;
  Direction direction = Direction::flexion;
  PulseFit pulse_scaling = PulseFit::amplitude;
  Arm arm = Arm::translating;
  bool velocity_is_given = true;       ///< false if it follows from angle and length
  bool equivalent_rigid_neck = false;  ///< true if it replaces the deformable neck
};

/// Content of [[test]]: a case that is judged by a test of a regulation.
struct TestSection {
  std::string name;
  std::string experiment;  ///< name of the case
  CertificationTest rules;
  std::filesystem::path file;   ///< file that contains the rules
  std::vector<FileRead> reads;  ///< this file and others that were read
};

/// Table of keys of study files, by section.
std::span<const Key> study_keys();

/// Content of a study file, checked and in SI units.
struct Study {
  std::filesystem::path file;
  std::vector<std::string> settings;          ///< override the file's values: key=value
  std::optional<StructureSection> structure;  ///< structure to be meshed, or …
  std::optional<MatricesSection> matrices;    ///< … matrices of another program
  std::vector<InterfaceSection> interfaces;
  std::vector<fe_modal::Load> loads;  ///< for a linear static step
  MeshOrders mesh_orders;
  ModesSection modes;
  SubstructuresSection substructures;
  Assembly model;  ///< all bodies, joints and forces from which the cases make their models
  std::vector<PulseSection> pulses;
  std::vector<CaseSection> cases;  ///< variants follow their base cases
  std::string dummy;               ///< dummy with this head and neck; empty if the study names none
  std::vector<TestSection> tests;  ///< in the order of display
  std::vector<MeasuredTest> measured;  ///< tests with measured data of the user
  /// Gravity in pendulum cases, in world axes.
  Eigen::Vector3d gravity_m_s2{0, 0, -kStandardGravity_m_s2};
  multibody::SolverOptions solver;
  double output_interval_s = 1e-3;
  std::filesystem::path verification;  ///< path of the table of reference figures; empty for none

  std::vector<InputFile> files;   ///< the study file and its includes
  std::vector<InputFile> tables;  ///< other files read for experiments: CSV files, bodies, …
  std::vector<InputFile> rules;   ///< files read for tests: regulations, measured curves
  std::vector<Parameter> parameters;
  std::vector<Parameter> defaults;  ///< values of keys that the study does not give

  /// Finds a rigid body. @throws InputError if there is no such body, or if it is not rigid.
  const multibody::RigidBody& rigid_body(const std::string& name) const;
  const MaterialModels& material_models() const;
  /// The neck's data; null for another structure.
  const NeckSection* neck() const;
  /// True if a material's modulus in static tests differs from that in the modes.
  bool has_static_moduli() const;
};

/// Reads a study. @throws InputError with file, line, column and key for any error.
Study read_study(const std::filesystem::path& path, const std::vector<std::string>& settings);

/// The Hybrid III study that runs by default.
std::filesystem::path built_in_study();
/// The certification test of the built-in study.
std::filesystem::path built_in_qualification();

}  // namespace flexneck::pipeline
