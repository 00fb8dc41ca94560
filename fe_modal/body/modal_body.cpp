// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/body/modal_body.h"

#include "fe_modal/body/basis_kind.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"

namespace flexneck::fe_modal {
namespace {

constexpr std::string_view kAllModes = "all";

InertiaInvariants select(const InertiaInvariants& all, const std::vector<Eigen::Index>& kept) {
  InertiaInvariants part;
  part.mass = all.mass;
  part.S1 = all.S1;
  part.J0 = all.J0;
  part.S2 = all.S2(Eigen::all, kept);
  part.N0 = all.N0(Eigen::all, kept);
  part.Maa = all.Maa(kept, kept);
  const auto m = static_cast<std::size_t>(all.Maa.rows());
  for (const Eigen::Index j : kept) {
    const auto row = static_cast<std::size_t>(j);
    part.G0.push_back(all.G0.at(row));
    for (const Eigen::Index l : kept) {
      part.G.push_back(all.G.at(row * m + static_cast<std::size_t>(l)));
      part.N.push_back(all.N.at(row * m + static_cast<std::size_t>(l)));
    }
  }
  return part;
}

GeometricStiffness select(const GeometricStiffness& all, const std::vector<Eigen::Index>& kept) {
  const auto part = [&](const std::vector<Eigen::MatrixXd>& whole) {
    std::vector<Eigen::MatrixXd> selected;
    selected.reserve(whole.size());
    for (const Eigen::MatrixXd& matrix : whole) selected.emplace_back(matrix(kept, kept));
    return selected;
  };
  GeometricStiffness selected{
      part(all.acceleration), part(all.angular_acceleration), part(all.velocity_products), {}, {}};
  for (const Eigen::Index k : kept)
    selected.modal_acceleration.emplace_back(
        all.modal_acceleration.at(static_cast<std::size_t>(k))(kept, kept));
  for (const GeometricStiffness::OfInterface& loads : all.interfaces) {
    selected.interfaces.push_back({loads.name, part(loads.force), part(loads.moment)});
  }
  return selected;
}

}  // namespace

const Interface& ModalBody::interface(const std::string& name) const {
  return interfaces[find_name(names_of(interfaces), name, "interface")];
}

Eigen::Index ModalBody::mode_index(const std::string& name) const {
  return static_cast<Eigen::Index>(find_name(names_of(modes), name, "mode"));
}

std::vector<std::string> selected_names(const ModalBody& body,
                                        const std::vector<std::string>& names) {
  std::vector<std::string> selected;
  for (const std::string& name : names) {
    bool is_kind = false;
    for (const ModeRecord& mode : body.modes) {
      if (mode.kind != name && (name != kAllModes || mode.kind == kRigidMode)) continue;
      selected.push_back(mode.name);
      is_kind = true;
    }
    if (!is_kind) selected.push_back(name);
  }
  return selected;
}

ModalBody select_modes(const ModalBody& body, const std::vector<std::string>& wanted) {
  const std::vector<std::string> names = selected_names(body, wanted);
  check_names(names, "mode");
  std::vector<Eigen::Index> kept;
  kept.reserve(names.size());
  for (const std::string& name : names) kept.push_back(body.mode_index(name));

  ModalBody part;
  part.frequencies_Hz = body.frequencies_Hz(kept);
  part.boundary = body.boundary;
  part.prestress = body.prestress;
  if (body.prestress_stiffness.size() > 0)
    part.prestress_stiffness = body.prestress_stiffness(kept);
  part.completeness = body.completeness;
  part.orthogonality = body.orthogonality;
  part.nodes_m = body.nodes_m;
  part.attached = body.attached;
  for (const Eigen::Index k : kept) {
    part.modes.push_back(body.modes.at(static_cast<std::size_t>(k)));
    part.shapes.push_back(body.shapes.at(static_cast<std::size_t>(k)));
  }
  for (const Interface& whole : body.interfaces) {
    part.interfaces.push_back({whole.name, whole.position_m, whole.translation(Eigen::all, kept),
                               whole.rotation(Eigen::all, kept), whole.response});
  }
  for (const SlitMotion& motion : body.slits)
    part.slits.push_back({motion.name, motion.opens, motion.amplitude(kept)});
  part.invariants = select(body.invariants, kept);
  if (body.geometric_stiffness) part.geometric_stiffness = select(*body.geometric_stiffness, kept);
  return part;
}

}  // namespace flexneck::fe_modal
