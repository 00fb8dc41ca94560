// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace flexneck::geometry {

/// Dimensions of the Hybrid III neck, in m. Frame: x forward, z from base to head, origin on the
/// plate axis at the base face. From below: base plate, rubber 1, plate 1, rubber 2, plate 2,
/// rubber 3, plate 3, rubber 4, top plate; the four rubber sections are equally high. Rubber
/// sections are straight cylinders shifted towards +x; the hole goes through everything.
struct NeckParameters {
  double length = 0;
  double base_plate_thickness = 0;
  double plate_thickness = 0;  ///< thickness of each of the three intermediate plates
  double top_plate_thickness = 0;
  double plate_diameter = 0;
  double hole_diameter = 0;
  double centre_rubber_diameter = 0;  ///< diameter of rubber 2 and 3
  double centre_rubber_offset = 0;
  double bottom_rubber_diameter = 0;  ///< diameter of rubber 1
  double bottom_rubber_offset = 0;
  double top_rubber_diameter = 0;  ///< diameter of rubber 4
  double top_rubber_offset = 0;
  double bolt_circle_radius = 0;
  double bolt_patch_radius = 0;  ///< base-face nodes this close to a bolt's centre are fixed
};

/// Description of one dimension.
struct NeckDimension {
  const char* name;  ///< name of the member, of the script's constant and of the key in a study
  double NeckParameters::*member;
  bool may_be_zero;
  const char* meaning;
};
/// All dimensions, in the order of NeckParameters.
std::span<const NeckDimension> neck_dimensions();

/// Mesh divisions of the neck's blocks.
struct NeckDivisions {
  int quadrant = 4;       ///< along a quarter of the circumference
  int inner_ring = 3;     ///< from the hole to the rubber's rim
  int outer_ring = 1;     ///< from the rubber's rim to the plate's
  int rubber_layers = 3;  ///< through one rubber section
  int plate_layers = 1;   ///< through an intermediate plate
  int end_plate_layers = 1;
  double ring_grading =
      1.15;  ///< ratio of neighbouring elements away from the rubber's rim, 1 = even
  double rubber_grading = 1.5;  ///< ratio of neighbouring layers away from the bonds, 1 = even
  /// Elements are divided into refine + 1 in each direction; the divisions keep the boundaries of
  /// the coarser elements and spread their ratios evenly, so that meshes with 0, 1, 3, 7 … nest.
  int refine = 0;
};

/// Divisions of a preset: "default", or "paper", evenly divided with as many elements as the paper
/// reports (2386 elements and 3427 nodes; these give 2400 and, with 8-node hexahedra, 3408).
/// @throws InputError for another name.
NeckDivisions divisions_preset(const std::string& name);
/// Number of hexahedra that the divisions give; a whole number that may exceed any integer type.
double hexahedra(const NeckDivisions& divisions);

/// Height of one rubber section: (length - plates) / 4.
double rubber_height(const NeckParameters& neck);

/// Centres of the four bolt patches on the base face, at 45, 135, 225 and 315 degrees.
std::array<std::array<double, 3>, 4> bolt_centres(const NeckParameters& neck);

/// A layer of the neck, a plate or a rubber section.
struct NeckLayer {
  std::string part;
  double bottom_m = 0;  ///< height of its lower face
  double thickness_m = 0;
  double diameter_m = 0;
  double offset_m = 0;  ///< offset of its axis towards the front
  bool is_rubber = false;
};
/// The nine layers from below.
std::vector<NeckLayer> layers_of(const NeckParameters& neck);

/// Refuses impossible dimensions.
/// @throws InputError with the inequality that fails and its values.
void check(const NeckParameters& neck);
void check(const NeckDivisions& divisions);

/// Values by name of the constants that geometry/neck.geo declares. Lengths in m.
std::map<std::string, double> script_constants(const NeckParameters& neck,
                                               const NeckDivisions& divisions);

}  // namespace flexneck::geometry
