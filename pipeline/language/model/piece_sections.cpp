// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/language/model/piece_sections.h"

#include <algorithm>
#include <variant>

#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "pipeline/language/model/model_sections.h"

namespace flexneck::pipeline {

using multibody::Section;

namespace {

/// Adds a mass at a marker whose axes are parallel to the body's.
void add_mass(const fe_modal::LumpedMass& mass, const multibody::Marker& marker,
              multibody::RigidBody& body) {
  const auto about = [](double m, const Eigen::Vector3d& r) -> Eigen::Matrix3d {
    return m * (r.squaredNorm() * Eigen::Matrix3d::Identity() - r * r.transpose());
  };
  const Eigen::Vector3d center = mass.first_moment_kg_m / mass.mass_kg;
  const Eigen::Vector3d place = marker.position_m + center;
  const double sum = body.mass_kg + mass.mass_kg;
  const Eigen::Vector3d common = (body.mass_kg * body.center_m + mass.mass_kg * place) / sum;
  body.inertia_kg_m2 += about(body.mass_kg, body.center_m - common) + mass.inertia_kg_m2 -
                        about(mass.mass_kg, center) + about(mass.mass_kg, place - common);
  body.mass_kg = sum;
  body.center_m = common;
}

}  // namespace

void use_condensed(const fe_modal::CondensedSection& piece, const StudyTable& table,
                   const std::string& key, std::size_t index, Assembly& assembly) {
  Section& section = assembly.model.forces.of<Section>()[index];
  const Eigen::Index size = piece.stiffness.rows() - 6;
  const Eigen::Index gaps = size - 6 - piece.slides;
  if (gaps > Section::kMaxGaps)
    table.refuse(key, "expected slits with at most " + std::to_string(Section::kMaxGaps) +
                          " openings, found " + std::to_string(gaps));
  if (piece.slides > Section::kMaxSlides)
    table.refuse(key, "expected a slit with at most " + std::to_string(Section::kMaxSlides) +
                          " sliding motions, found " + std::to_string(piece.slides));
  section.friction.slides = piece.slides;
  section.rest_m = piece.top_m - piece.base_m;
  section.stiffness = piece.stiffness.bottomRightCorner(size, size);
  const std::array<fe_modal::LumpedMass, 2> ends = fe_modal::lumped_masses(piece);
  const std::array<std::size_t, 2> markers = {section.marker_i, section.marker_j};
  for (std::size_t end = 0; end < 2; ++end) {
    const multibody::Marker& marker = assembly.model.markers[markers[end]];
    if (!assembly.lumped.contains(marker.body)) continue;
    if (!marker.rotation.isApprox(Eigen::Quaterniond::Identity()))
      table.refuse(end == 0 ? "lower" : "upper",
                   "expected a marker with the axes of its body, since the mass of the body is "
                   "lumped from sections");
    add_mass(ends[end], marker,
             std::get<multibody::RigidBody>(assembly.model.bodies[marker.body].kind));
  }
}

fe_modal::Sliding sliding_of(const Section& section) {
  return section.friction.coefficient > 0 ? fe_modal::Sliding::kept : fe_modal::Sliding::free;
}

void attach_pieces(const Pieces& pieces, Assembly& assembly) {
  for (const PieceUse& use : assembly.of_pieces) {
    const auto piece = pieces.find(use.piece);
    if (piece == pieces.end()) {
      std::vector<std::string> names;
      for (const auto& each : pieces) names.push_back(each.first);
      at_key(use.table, "piece",
             [&] { return find_name(names, use.piece, "piece of [substructures]"); });
    }
    const fe_modal::CondensedSection condensed = at_key(use.table, "piece", [&] {
      const Section& section = assembly.model.forces.of<Section>()[use.section];
      return fe_modal::condense(piece->second, use.base, use.top, sliding_of(section));
    });
    use_condensed(condensed, use.table, "piece", use.section, assembly);
    Section& section = assembly.model.forces.of<Section>()[use.section];
    use.relaxation.apply(use.relaxation.sum_of_shares() * section.stiffness, section);
  }
  assembly.of_pieces.clear();
}

}  // namespace flexneck::pipeline
