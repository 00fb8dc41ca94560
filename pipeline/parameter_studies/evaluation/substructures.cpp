// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/parameter_studies/evaluation/substructures.h"

#include <algorithm>
#include <utility>

#include <fmt/core.h>

#include "fe_modal/body/condensed_section.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "mesher/mesh/positions.h"
#include "pipeline/language/model/model_sections.h"

namespace flexneck::pipeline {
namespace {

mesher::PieceOfElement piece_of_element(const SubstructuresSection& section,
                                        const mesher::Mesh& mesh) {
  if (section.by_planes) {
    std::vector<double> offsets_m;
    for (const PieceSection& piece : section.pieces) {
      if (piece.up_to_m) offsets_m.push_back(*piece.up_to_m);
    }
    return mesher::pieces_by_planes(mesh, section.normal, offsets_m);
  }
  std::vector<std::vector<std::string>> parts;
  for (const PieceSection& piece : section.pieces) parts.push_back(piece.parts);
  return mesher::pieces_by_parts(mesh, parts);
}

const mesher::FaceSet* face_set(const mesher::Mesh& mesh, const std::string& name) {
  const auto found = std::find_if(mesh.face_sets.begin(), mesh.face_sets.end(),
                                  [&](const mesher::FaceSet& set) { return set.name == name; });
  return found == mesh.face_sets.end() ? nullptr : &*found;
}

Eigen::Vector3d middle_of(const mesher::Mesh& mesh, const mesher::FaceSet& faces) {
  return mesher::positions_of(mesh, mesher::nodes_of(faces).nodes).rowwise().mean();
}

/// Interfaces of the whole structure that lie on the submesh.
std::vector<fe_modal::InterfaceDefinition> interfaces_on(const mesher::Mesh& piece,
                                                         const mesher::Mesh& whole,
                                                         const fe_modal::ModalOptions& options) {
  std::vector<fe_modal::InterfaceDefinition> result;
  for (const fe_modal::InterfaceDefinition& interface : options.interfaces) {
    const mesher::FaceSet* const own = face_set(piece, interface.set);
    if (own == nullptr) continue;
    if (mesher::nodes_of(*own).nodes.size() !=
        mesher::nodes_of(whole.face_set(interface.set)).nodes.size()) {
      throw InputError("interface '" + interface.name +
                       "' extends over several substructures; use another cutting plane");
    }
    result.push_back(interface);
  }
  return result;
}

/// Fixes a submesh at its cut with the first of the earlier submeshes that it touches.
void hold_at_earlier(const std::vector<std::string>& names, std::size_t piece,
                     const mesher::Mesh& mesh, fe_modal::ModalOptions& options) {
  for (std::size_t earlier = 0; earlier < piece; ++earlier) {
    const std::string cut = mesher::cut_name(names[earlier]);
    const mesher::FaceSet* const faces = face_set(mesh, cut);
    if (faces == nullptr) continue;
    options.fixed_set = options.fixed_interface = cut;
    options.fixed_position_m = middle_of(mesh, *faces);
    return;
  }
  throw InputError("substructure '" + names[piece] +
                   "' is not adjacent to any substructure before it; list the substructures in "
                   "order from the fixed end");
}

bool has_open_slit(const mesher::Mesh& mesh) {
  return std::any_of(mesh.slits.begin(), mesh.slits.end(),
                     [](const mesher::Slit& slit) { return !slit.tied; });
}

fe_modal::ModalOptions options_of(const SubstructuresSection& section,
                                  const std::vector<std::string>& names, std::size_t piece,
                                  const mesher::Mesh& mesh, const mesher::Mesh& whole,
                                  const fe_modal::ModalOptions& whole_options) {
  fe_modal::ModalOptions options = whole_options;
  options.basis = fe_modal::BasisKind::craig_bampton;
  options.basis_interfaces.clear();
  options.mode_count = section.modes;
  options.slit_motions = has_open_slit(mesh) ? section.slit_motions : fe_modal::SlitMotions::none;
  options.check = false;
  options.rigid_parts.clear();
  options.interfaces.clear();
  options.sign_interface.clear();
  options.attachments.clear();
  options.node_order.clear();
  options.element_ranks.clear();
  if (piece > 0) hold_at_earlier(names, piece, mesh, options);
  for (const std::string& name : names) {
    const std::string cut = mesher::cut_name(name);
    const mesher::FaceSet* const faces = face_set(mesh, cut);
    if (faces == nullptr || cut == options.fixed_set) continue;
    options.interfaces.push_back({cut, cut, middle_of(mesh, *faces)});
  }
  for (auto& interface : interfaces_on(mesh, whole, whole_options)) {
    options.interfaces.push_back(std::move(interface));
  }
  if (!options.interfaces.empty()) options.sign_interface = options.interfaces.front().name;
  return options;
}

}  // namespace

std::vector<Substructure> substructures(const SubstructuresSection& section,
                                        const mesher::Mesh& mesh,
                                        const fe_modal::ModalOptions& whole) {
  if (section.slit_motions != fe_modal::SlitMotions::none && !has_open_slit(mesh))
    throw InputError("slits: the mesh has no open slit; set geometry.slits = \"open\"");
  if (!whole.prestress.empty())
    throw InputError("a prestress is not supported with substructures; remove modes.prestress");
  const std::vector<std::string> names = names_of(section.pieces);
  std::vector<mesher::MeshPiece> pieces =
      mesher::cut_apart(mesh, piece_of_element(section, mesh), names);
  std::vector<Substructure> result;
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    fe_modal::ModalOptions options = options_of(section, names, p, pieces[p].mesh, mesh, whole);
    result.push_back({names[p], std::move(pieces[p].mesh), std::move(options)});
  }
  return result;
}

std::vector<Substructure> substructures_of(const Study& study, const mesher::Mesh& mesh,
                                           const fe_modal::ModalOptions& whole) {
  try {
    return substructures(study.substructures, mesh, whole);
  } catch (const InputError& error) {
    throw InputError(study.file.string() + ": substructures: " + error.what());
  }
}

void require_rigid_face(const Study& study, const Substructure& piece,
                        const fe_modal::ModalBody& body) {
  constexpr double kLargest = 0.05;
  for (const CaseSection& experiment : study.cases)
    for (const PieceUse& use : experiment.model.of_pieces) {
      if (use.piece != piece.name) continue;
      const auto& interfaces = piece.options.interfaces;
      const std::size_t top = at_key(
          use.table, "top", [&] { return find_name(names_of(interfaces), use.top, "interface"); });
      std::vector<Eigen::Index> nodes;
      for (const std::size_t node :
           mesher::nodes_of(piece.mesh.face_set(interfaces[top].set)).nodes)
        nodes.push_back(static_cast<Eigen::Index>(node));
      const double warp = fe_modal::warp_of_face(body, use.top, nodes);
      if (!(warp <= kLargest))
        use.table.refuse(
            "top", fmt::format(
                       "the face '{}' of substructure '{}' is not rigid enough to be condensed: it "
                       "warps by {:.2g} of its motion, expected at most {:g}; cut at a stiff plate",
                       use.top, piece.name, warp, kLargest));
      break;
    }
}

}  // namespace flexneck::pipeline
