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
#include "fe_modal/system/solver.h"
#include "geometry/foundation/provenance.h"
#include "geometry/foundation/units.h"
#include "multibody/joints/joint_kinds.h"
#include "multibody/model/model.h"
#include "multibody/simulation/simulation.h"
#include "pipeline/document/key.h"
#include "pipeline/model/pulse.h"
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
  fe_modal::Solver solver = fe_modal::Solver::direct;
  fe_modal::BasisKind basis = fe_modal::BasisKind::normal;
  bool stress_stiffening = false;             ///< geometric stiffness of the modes under unit loads
  std::vector<std::string> rigid_interfaces;  ///< whose nodes are tied to move rigidly
  std::vector<std::string> basis_interfaces;  ///< whose static shapes join the basis; empty: all
  bool certify = false;  ///< prove that no mode is missing, estimate the error of the mesh
  std::vector<std::string> fixed;  ///< node sets fixed in all directions
  std::map<std::string, std::array<bool, 3>> fixed_directions;  ///< others, in some of x, y, z
  std::vector<std::string> rigid_parts;  ///< parts whose motion names the modes
  std::string attached_body;  ///< rigid body set on an interface for the loaded frequencies
  std::string attached_to;    ///< that interface; empty: the first
};

/// [[body]]
struct BodySection {
  enum class Kind { ground, prescribed, rigid, deformable };
  std::string name;
  Kind kind = Kind::rigid;
  multibody::RigidBody rigid;
  std::vector<std::string> modes;  ///< of a deformable body
  double damping_ratio = 0;
  /// Of modes that only complete the static compliance.
  double correction_damping_ratio = 0;
};

/// [[marker]]; the interfaces of deformable bodies are markers without being listed.
struct MarkerSection {
  std::string name;  ///< "body.marker"
  std::string body;
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
};

/// [[joint]]: the lower body's marker first.
struct JointSection {
  std::string name;
  const multibody::JointKind* kind = &multibody::kFixedJoint;
  std::string marker_i, marker_j;
  Eigen::Vector3d axis = Eigen::Vector3d::UnitY();
};

/// [[force]]
struct ForceSection {
  std::string name;
  std::string marker;
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();  ///< unit vector, world
  std::vector<double> times_s;
  std::vector<double> magnitudes_N;
};

/// [[pulse]]: a deceleration; a case brings it to its impact velocity.
struct PulseSection {
  std::string name;
  std::vector<double> times_s;  ///< from 0 or later on, strictly increasing
  std::vector<double> deceleration_m_s2;
};

/// [[rigid_neck]]: the neck of the older model, a rigid link between two pivots that turn in the
/// plane of the case.
struct RigidNeckSection {
  /// Springs and damper of a pivot: in the fore-aft plane, flexion positive, and in the lateral.
  struct Pivot {
    double height_m = 0;  ///< above the base, on the neck's axis
    multibody::Resistance fore_aft, lateral;
  };
  std::string name;
  /// Made to have the mass, the static stiffness and the damping of the deformable neck.
  bool is_equivalent = false;
  multibody::RigidBody rigid;  ///< otherwise: neck frame,
  Pivot lower, upper;          ///< and these
};

/// [[head_spring]]: nodding blocks and cable as a pin in place of the fixed joint of the head.
struct HeadSpringSection {
  std::string name;
  Eigen::Vector3d axis = Eigen::Vector3d::UnitY();
  multibody::Resistance resistance;
};

/// [[case]]: one experiment. Its bodies, and the joints between them, make the model. Keys that all
/// experiments of a kind share stand in [pendulum] and [static]; a [[variant]] makes cases of other
/// ones.
struct CaseSection {
  enum class Kind { pendulum, static_test };
  enum class Direction { flexion, extension, lateral };
  enum class Arm { translating, rotating };
  std::string name;
  std::string variant_of;  ///< the case that a [[variant]] made this of; empty for none
  std::string variant;     ///< name of that variant
  Kind kind = Kind::pendulum;
  std::vector<std::string> bodies;
  std::vector<std::string> forces;  ///< of a static test
  Direction direction = Direction::flexion;
  double duration_s = 1.0;
  // Of a pendulum:
  std::optional<double> drop_angle_rad;
  std::optional<double> effective_length_m;  ///< of the pendulum as one of a point
  double impact_velocity_m_s = 0;
  bool velocity_is_given = true;  ///< otherwise it follows from angle and length
  std::string pulse;
  PulseFit pulse_scaling = PulseFit::amplitude;
  Arm arm = Arm::translating;
  double pivot_distance_m = 0;          ///< rotating: from the arm's pivot to the neck's base
  double accelerometer_distance_m = 0;  ///< rotating: to where velocity and pulse are measured
  MomentDefinition moment;              ///< of the virtual load cell
  std::string rigid_neck;               ///< in place of the deformable one; empty for none
  std::string head_spring;              ///< in place of the head's fixed joint; empty for none
};

/// [[test]]: a case that is judged by a test of a regulation.
struct TestSection {
  std::string name;
  std::string experiment;  ///< the case
  CertificationTest rules;
  std::filesystem::path file;  ///< that the rules stand in
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
  MeshOrders mesh_orders;
  ModesSection modes;
  SubstructuresSection substructures;
  std::vector<BodySection> bodies;
  std::vector<MarkerSection> markers;
  std::vector<JointSection> joints;
  std::vector<ForceSection> forces;
  std::vector<PulseSection> pulses;
  std::vector<RigidNeckSection> rigid_necks;
  std::vector<HeadSpringSection> head_springs;
  std::vector<CaseSection> cases;  ///< variants after those they are made of
  std::string dummy;               ///< whose head and neck it is; empty if the study does not say
  std::vector<TestSection> tests;  ///< in the order in which they are shown
  Eigen::Vector3d gravity_m_s2{0, 0, -kStandardGravity_m_s2};  ///< of pendulum cases, world
  multibody::SolverOptions solver;
  double output_interval_s = 1e-3;
  std::filesystem::path verification;  ///< table of reference figures; empty for none

  std::vector<InputFile> files;   ///< of the study itself
  std::vector<InputFile> tables;  ///< CSV files that it names
  std::vector<Parameter> parameters;
  std::vector<std::string> warnings;  ///< of names of earlier versions
  std::vector<Parameter> defaults;    ///< what holds for keys that the study does not give

  const BodySection& body(const std::string& name) const;
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

}  // namespace flexneck::pipeline
