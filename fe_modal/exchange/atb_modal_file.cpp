// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/exchange/atb_modal_file.h"

#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "fe_modal/exchange/corner_fields.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/output_file.h"
#include "geometry/foundation/units.h"

namespace flexneck::fe_modal {
namespace {

constexpr std::size_t kMaxNodes = 4000;
constexpr std::size_t kMaxModes = 4;

/// Indices of the lowest modes that are eigenvectors and no rigid motions.
/// @throws InputError for a prestressed body, since the ATB would apply its loads again.
std::vector<std::size_t> modes_to_write(const ModalBody& body) {
  if (!body.prestress.empty())
    throw InputError(
        "the ATB would apply the loads of the prestress a second time; make the modes without "
        "modes.prestress");
  std::vector<std::size_t> modes;
  for (std::size_t k = 0; k < body.modes.size() && modes.size() < kMaxModes; ++k) {
    if (body.modes[k].kind == "normal") modes.push_back(k);
  }
  if (modes.empty())
    throw InputError("the ATB supports only normal modes, of which this body has none");
  return modes;
}

std::string record(std::span<const double> numbers) {
  std::string line;
  for (const double number : numbers) line += " " + exact_text(number);
  return line + "\n";
}

/// A mode at the corners in the units of the file, mass-normalised in these: (6, n).
Eigen::MatrixXd shape_at(const mesher::Mesh& mesh, const CornerMasses& corners,
                         const Eigen::VectorXd& masses, const Eigen::Matrix3Xd& shape,
                         double inches_per_metre) {
  Eigen::MatrixXd result(6, masses.size());
  // A unit displacement in the program is one inch instead of one metre, with the same rotation.
  result.topRows<3>() = inches_per_metre * shape(Eigen::all, corners.nodes);
  result.bottomRows<3>() = corner_rotations(mesh, corners.nodes, shape);
  const double modal_mass = result.topRows<3>().colwise().squaredNorm() * masses;
  return result / std::sqrt(modal_mass);
}

constexpr const char* kNotes =
    "\nNotes, which are not read. Modal file for the ATB, version V.3, by flexneck.\n"
    "Inferred from how that program reads its file, for no manual of it is published: the order\n"
    "(numbers of nodes and modes; positions; masses; frequencies in Hz; modes), nodal masses that\n"
    "are no weights, and of each node in a mode three translations and three rotations in rad.\n"
    "Inferred from its usual decks: the units in, lbf and s; masses are in lbf s^2/in.\n"
    "Nodes are the corners of the finite elements. sum m |translation|^2 = 1 for each mode, and "
    "the\n"
    "rotations, half the curl of the displacement, are scaled alike.\n";

std::string list_of_modes(const ModalBody& body, const std::vector<std::size_t>& modes) {
  std::string text = "Modes:";
  for (const std::size_t mode : modes) {
    text += (mode == modes.front() ? " " : ", ") + body.modes[mode].name;
  }
  return text + "; " + body.boundary + ".\n";
}

}  // namespace

void write_atb_modal_file(const std::filesystem::path& path, const mesher::Mesh& mesh,
                          const ModalBody& body) {
  const CornerMasses corners = lump_at_corners(mesh);
  if (corners.nodes.size() > kMaxNodes) {
    throw InputError("the ATB supports at most " + std::to_string(kMaxNodes) +
                     " nodes; this mesh has " + std::to_string(corners.nodes.size()) +
                     " corner nodes; use a coarser mesh");
  }
  const std::vector<std::size_t> modes = modes_to_write(body);
  const double inches_per_metre = factor_from_si("m", "in");
  const Eigen::VectorXd masses = factor_from_si("kg", "lbf*s^2/in") * corners.masses_kg;

  OutputFile file(path);
  file.write(std::to_string(corners.nodes.size()) + " " + std::to_string(modes.size()) + "\n");
  for (const std::int32_t node : corners.nodes) {
    const Eigen::Vector3d position = inches_per_metre * body.nodes_m.col(node);
    file.write(record({position.data(), 3}));
  }
  for (const double mass : masses) file.write(record({&mass, 1}));
  const Eigen::VectorXd hertz = body.frequencies_Hz(modes);
  file.write(record({hertz.data(), modes.size()}));
  for (const std::size_t mode : modes) {
    const Eigen::MatrixXd shape =
        shape_at(mesh, corners, masses, body.shapes[mode], inches_per_metre);
    for (Eigen::Index k = 0; k < shape.cols(); ++k) file.write(record({shape.col(k).data(), 6}));
  }
  file.write(kNotes + list_of_modes(body, modes));
  file.commit();
}

}  // namespace flexneck::fe_modal
