// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/element/formulation.h"

#include <algorithm>
#include <array>
#include <string>

#include "geometry/foundation/error.h"
#include "geometry/foundation/output_file.h"
#include "mesher/mesh/mesh_measures.h"

namespace flexneck::fe_modal {
namespace {

using mesher::ElementKind;

struct NamedFormulation {
  Formulation formulation;
  std::string_view name;
};

constexpr std::array<NamedFormulation, 3> kFormulations = {{
    {Formulation::mixed_pressure, "mixed_pressure"},
    {Formulation::displacement, "displacement"},
    {Formulation::reduced, "reduced"},
}};

// Full integration has the strength at which a constant strain is exact in curved elements too.
//
// The pressures of an element are those, among the possible ones, with the best results on a bonded
// rubber pad (tests/benchmarks/fe_locking_benchmark): fewer make the 20-node hexahedron and the
// prisms as much too soft as displacements alone make them too stiff, more make the 15-node prism
// lock.
//
// Linear pressures project the bulk part: on the 26k-DOF neck, set A, of 27-node hexahedra the
// first bending frequency is 0.03 % from the converged one instead of 0.4 %. Constant pressures do
// not represent bending: with the bulk part a slender beam of steel, two elements of tet10 thick,
// is 5 % too soft, with the Lame part 0.02 % too stiff; a bonded pad loses 0.3 %. The 8-node
// hexahedron with constant pressure and bulk part is the well-known B-bar element.
constexpr std::array<ElementScheme, 22> kSchemes = {{
    {ElementKind::hex8, Formulation::mixed_pressure, 2, PressureSpace::constant,
     VolumetricPart::bulk},  // B-bar
    {ElementKind::hex8, Formulation::displacement, 2, PressureSpace::none, VolumetricPart::bulk},
    {ElementKind::hex20, Formulation::mixed_pressure, 3, PressureSpace::linear,
     VolumetricPart::bulk},
    {ElementKind::hex20, Formulation::displacement, 3, PressureSpace::none, VolumetricPart::bulk},
    {ElementKind::hex20, Formulation::reduced, 2, PressureSpace::none, VolumetricPart::bulk},
    {ElementKind::hex27, Formulation::mixed_pressure, 3, PressureSpace::linear,
     VolumetricPart::bulk},
    {ElementKind::hex27, Formulation::displacement, 3, PressureSpace::none, VolumetricPart::bulk},
    {ElementKind::prism6, Formulation::mixed_pressure, 2, PressureSpace::constant,
     VolumetricPart::bulk},
    {ElementKind::prism6, Formulation::displacement, 2, PressureSpace::none, VolumetricPart::bulk},
    {ElementKind::prism15, Formulation::mixed_pressure, 3, PressureSpace::along_axis,
     VolumetricPart::lame},
    {ElementKind::prism15, Formulation::displacement, 3, PressureSpace::none, VolumetricPart::bulk},
    {ElementKind::prism18, Formulation::mixed_pressure, 3, PressureSpace::linear,
     VolumetricPart::bulk},
    {ElementKind::prism18, Formulation::displacement, 3, PressureSpace::none, VolumetricPart::bulk},
    // A constant pressure changes nothing if the divergence is constant: tet4 has no mixed
    // formulation.
    {ElementKind::tet4, Formulation::displacement, 1, PressureSpace::none, VolumetricPart::bulk},
    {ElementKind::tet10, Formulation::mixed_pressure, 3, PressureSpace::constant,
     VolumetricPart::lame},
    {ElementKind::tet10, Formulation::displacement, 3, PressureSpace::none, VolumetricPart::bulk},
    {ElementKind::pyramid5, Formulation::mixed_pressure, 2, PressureSpace::constant,
     VolumetricPart::bulk},
    {ElementKind::pyramid5, Formulation::displacement, 2, PressureSpace::none,
     VolumetricPart::bulk},
    {ElementKind::pyramid13, Formulation::mixed_pressure, 3, PressureSpace::constant,
     VolumetricPart::lame},
    {ElementKind::pyramid13, Formulation::displacement, 3, PressureSpace::none,
     VolumetricPart::bulk},
    {ElementKind::pyramid14, Formulation::mixed_pressure, 3, PressureSpace::constant,
     VolumetricPart::lame},
    {ElementKind::pyramid14, Formulation::displacement, 3, PressureSpace::none,
     VolumetricPart::bulk},
}};

/// Largest ratio of longest to shortest edge at which a finer mesh was shown to reveal the error in
/// bending of one layer of tetrahedra or pyramids (mesh_error_benchmark: at 10 it does, at 50 it
/// does not).
constexpr double kSlender = 10;

bool locks_if_slender(ElementKind kind) {
  return kind == ElementKind::tet10 || kind == ElementKind::pyramid13 ||
         kind == ElementKind::pyramid14;
}

}  // namespace

Formulation FormulationChoice::of(const mesher::Material& material) const {
  const auto found = of_material.find(material.name);
  return found == of_material.end() ? of_others : found->second;
}

std::vector<std::string> locking_warnings(const mesher::Mesh& mesh,
                                          const FormulationChoice& formulation) {
  constexpr double kNearlyIncompressible = 0.45;
  std::vector<std::string> lines;
  for (const mesher::ElementBlock& block : mesh.blocks) {
    const std::string part = "part '" + block.part + "' has elements of kind " +
                             std::string(mesher::name_of(block.kind));
    if (block.kind == ElementKind::tet4 || block.kind == ElementKind::pyramid5)
      lines.push_back(part +
                      ", which are linear and far too stiff in bending and shear unless the mesh "
                      "is very fine; use quadratic elements");
    if (!locks_if_slender(block.kind)) continue;
    if (const double ratio = mesher::measure(mesh, block).max_aspect_ratio; ratio > kSlender)
      lines.push_back(
          part + " with an aspect ratio of up to " + rounded_text(ratio, 2) +
          "; a single layer of them is too stiff in bending, even when refined, so that the "
          "estimated discretisation error is too small; use hexahedra or shorter elements");
  }
  for (const mesher::Material& material : mesh.materials) {
    const Formulation chosen = formulation.of(material);
    if (chosen == Formulation::mixed_pressure) continue;
    if (!(material.poissons_ratio > kNearlyIncompressible)) continue;
    lines.push_back("material '" + material.name + "' with Poisson's ratio " +
                    rounded_text(material.poissons_ratio) + " in formulation '" +
                    std::string(name_of(chosen)) +
                    "' makes elements too stiff; use mixed_pressure");
  }
  return lines;
}

std::string_view name_of(Formulation formulation) {
  return kFormulations.at(static_cast<std::size_t>(formulation)).name;
}

Formulation formulation_from(std::string_view name) {
  std::string known;
  for (const NamedFormulation& row : kFormulations) {
    if (row.name == name) return row.formulation;
    known += (known.empty() ? "" : ", ") + std::string(row.name);
  }
  throw InputError("unknown formulation '" + std::string(name) + "', expected one of " + known);
}

const ElementScheme& element_scheme(mesher::ElementKind kind, Formulation formulation) {
  std::string offered;
  for (const ElementScheme& scheme : kSchemes) {
    if (scheme.kind != kind) continue;
    if (scheme.formulation == formulation) return scheme;
    offered += (offered.empty() ? "" : ", ") + std::string(name_of(scheme.formulation));
  }
  throw InputError("elements of kind " + std::string(mesher::name_of(kind)) +
                   " have no formulation '" + std::string(name_of(formulation)) + "', " +
                   (offered.empty() ? "and no other one" : "expected one of " + offered));
}

}  // namespace flexneck::fe_modal
