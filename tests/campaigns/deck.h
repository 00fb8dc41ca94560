// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "mesher/mesh/mesh.h"
#include "tests/campaigns/campaign.h"

namespace flexneck::campaigns {

/// A component from 1 to 6 of a node, in the node's axes; nodes of elements are counted first, then
/// points.
struct DeckPlace {
  std::size_t node = 0;
  int component = 1;
};

/// Axes of some nodes by three points: the origin, one on the z axis and one in the half plane
/// x > 0, y = 0.
struct DeckAxes {
  bool is_cylindrical = false;
  Eigen::Vector3d origin, on_z, in_xz;
  std::vector<std::size_t> nodes;

  Eigen::Matrix3d frame() const;                              ///< columns x, y, z
  Eigen::Matrix3d at(const Eigen::Vector3d& position) const;  ///< radial, tangential, axial
};

/// Content of a deck in its own units, with numbers that its fields hold exactly.
struct Deck {
  double length_m = 1, force_N = 1;
  double density = 1, youngs_modulus = 1, poissons_ratio = 0.3;
  mesher::ElementKind kind = mesher::ElementKind::hex8;
  std::vector<std::vector<std::size_t>> elements;  ///< nodes in the mesh's order
  std::vector<Eigen::Vector3d> places;             ///< positions of nodes, then of points
  std::size_t points = 0;
  std::vector<int> numbers, element_numbers;
  int number_step = 0;  ///< step of the nodes' numbers; 0 if they are shuffled
  std::vector<std::size_t> bottom, top;
  struct Hold {
    std::size_t node;
    std::string components;  ///< digits, ascending
  };
  struct Equation {
    std::vector<DeckPlace> places;
    std::vector<double> coefficients;
  };
  struct Spring {
    DeckPlace one, other;
    bool has_other;
    double stiffness;
  };
  struct Mass {
    std::size_t node;
    double mass;
    Eigen::Vector3d center;
    std::array<double, 6> inertia;  ///< xx, yy, zz, xy, xz, yz of the tensor about the centre
  };
  struct Coupling {
    std::size_t point;
    std::vector<std::size_t> nodes;
    std::string components;
  };
  std::vector<Hold> holds;
  std::vector<Equation> equations;
  std::vector<Equation> pins;  ///< three each: two nodes move as one
  std::vector<Spring> springs;
  std::vector<Mass> masses;
  std::vector<Coupling> couplings;
  std::vector<DeckAxes> axes;

  std::size_t nodes() const { return places.size() - points; }
};

/// Writes the deck in one of many equivalent ways, as `name` with its ending and the files that it
/// includes. If `refused`, it contains something that the format's reader cannot interpret.
/// @return what that is; else nothing
std::string write_inp(Case& drawn, const Deck& deck, const std::filesystem::path& file,
                      bool refused);
std::string write_bdf(Case& drawn, const Deck& deck, const std::filesystem::path& file,
                      bool refused);
/// Writes nodes, elements and the sets "bottom" and "top".
std::string write_unv(Case& drawn, const Deck& deck, const std::filesystem::path& file,
                      bool refused);
std::string write_msh(Case& drawn, const Deck& deck, const std::filesystem::path& file,
                      bool refused);

}  // namespace flexneck::campaigns
