// SPDX-License-Identifier: GPL-3.0-or-later
// Force elements that resist all six relative motions of two markers.
#include <cmath>

#include "fe_modal/body/condensed_section.h"
#include "geometry/foundation/error.h"
#include "pipeline/language/document/table_values.h"
#include "pipeline/language/model/model_sections.h"
#include "pipeline/language/model/modes_path.h"
#include "pipeline/language/model/relaxation.h"
#include "pipeline/process/result_files.h"

namespace flexneck::pipeline {
namespace {

using Eigen::Vector3d;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

constexpr auto kBushingKeys = std::to_array<Key>({
    Key::text("name", kRequired, "Name of the bushing"),
    Key::text("lower", kRequired, "First marker, in whose axes the matrices are given"),
    Key::text("upper", kRequired, "Second marker"),
    Key::quantities(
        "translation_stiffness", "N/m", kNone,
        "Stiffness, forces per translation: three diagonal entries, or nine row by row"),
    Key::quantities("rotation_stiffness", "N*m/rad", kNone,
                    "Stiffness, moments per rotation: three diagonal entries, or nine row by row"),
    Key::quantities("coupling_stiffness", "N/rad", kNone,
                    "Stiffness, forces per rotation: three diagonal entries, or nine row by row"),
    Key::quantities("translation_damping", "N*s/m", kNone,
                    "Damping, forces per velocity: three diagonal entries, or nine row by row"),
    Key::quantities(
        "rotation_damping", "N*m*s/rad", kNone,
        "Damping, moments per angular velocity: three diagonal entries, or nine row by row"),
    Key::quantities(
        "coupling_damping", "N*s/rad", kNone,
        "Damping, forces per angular velocity: three diagonal entries, or nine row by row"),
});

constexpr auto kSectionKeys = joined(
    std::to_array<Key>({
        Key::text("name", kRequired, "Name of the section"),
        Key::text("lower", kRequired,
                  "Marker at the base, in whose axes length and stiffness are given"),
        Key::text("upper", kRequired,
                  "Marker at the top, with the orientation of the lower one in the unloaded state"),
        Key::quantities("length", "m", kNone,
                        "Vector from the lower to the upper marker in the unloaded state",
                        {.size = 3}),
        Key::quantities("translation_stiffness", "N/m", kNone,
                        "Forces at the top per translation of the top, with the base fixed: three "
                        "diagonal entries, or nine row by row"),
        Key::quantities(
            "rotation_stiffness", "N*m/rad", kNone,
            "Stiffness, moments per rotation: three diagonal entries, or nine row by row"),
        Key::quantities(
            "coupling_stiffness", "N/rad", kNone,
            "Stiffness, forces per rotation: three diagonal entries, or nine row by row"),
        Key::quantities("gap_stiffness", "N/m", kNone,
                        "Forces of the slits' gaps per opening: a square matrix row by row; the "
                        "other stiffnesses apply to closed gaps"),
        Key::quantities(
            "bending_angles", "rad", kNone,
            "Nonlinear bending curve: angles between the ends under bending moments, the first 0"),
        Key::quantities("bending_moments", "N*m", kNone,
                        "Bending moment at each angle, the first 0; the stiffness is scaled by the "
                        "ratio of the curve's slope to its first slope"),
        Key::quantities("gap_translation_coupling", "N/m", kNone,
                        "Force of each gap per translation of the top, three per gap; negative if "
                        "the motion opens the gap"),
        Key::quantities("gap_rotation_coupling", "N/rad", kNone,
                        "Force of each gap per rotation of the top, three per gap; negative if the "
                        "motion opens the gap"),
        Key::file("modes_file", kNone,
                  "Instead of length and stiffness: modes file of a body with a fixed base whose "
                  "modes are the static shapes of its top and of its opening slits"),
        kMadeByKey,
        Key::text("piece", kNone,
                  "Instead of modes_file, in a study: the substructure of [substructures] that "
                  "forms the section"),
        Key::text("base", kNone, "Interface of the substructure or modes_file at the fixed nodes"),
        Key::text("top", kNone,
                  "Interface of the substructure or modes_file that has the static shapes"),
        Key::number("slit_friction", "0",
                    "Coefficient of Coulomb friction between the sides of the closed slit, for a "
                    "substructure or modes_file with one slit and slits = "
                    "\"openings-and-sliding\"; 0: the sides slide freely",
                    {.range = at_least(0)}),
        Key::quantity("slit_sliding_time", "s", "0.0001",
                      "With slit_friction: time constant with which the sides of an open slit "
                      "slide to their unloaded position, and those of a closed slit to the "
                      "position where friction holds them",
                      {.range = kPositive}),
        Key::file("slow_modes_file", kNone,
                  "Like modes_file, with the moduli of slow motions; without it, relaxation_shares "
                  "apply to the whole stiffness"),
    }),
    kRelaxationKeys);

/// Reads a 3x3 block: nine numbers row by row, or three on the diagonal.
Eigen::Matrix3d block(const StudyTable& table, const std::string& key, const std::string& unit) {
  if (!table.has(key)) return Eigen::Matrix3d::Zero();
  const std::vector<double> values = table.quantities(key, 0, unit);
  if (values.size() == 3)
    return Eigen::Map<const Vector3d>(values.data()).asDiagonal().toDenseMatrix();
  if (values.size() != 9)
    table.refuse(key, "expected 3 entries (a diagonal) or 9 (a matrix row by row), found " +
                          std::to_string(values.size()));
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(values.data());
}

/// Reads a 6x6 matrix.
/// @param rate  "" for a stiffness, "*s" for a damping
Matrix6d matrix_of(const StudyTable& table, const std::string& what, const std::string& rate) {
  Matrix6d matrix;
  const Eigen::Matrix3d coupling = block(table, "coupling_" + what, "N" + rate + "/rad");
  matrix << block(table, "translation_" + what, "N" + rate + "/m"), coupling, coupling.transpose(),
      block(table, "rotation_" + what, "N*m" + rate + "/rad");
  return matrix;
}

void read_bushing(const StudyTable& table, Assembly& assembly) {
  multibody::Bushing bushing;
  bushing.name = table.text("name");
  bushing.marker_i = marker_named(table, "lower", assembly);
  bushing.marker_j = marker_named(table, "upper", assembly);
  bushing.stiffness = matrix_of(table, "stiffness", "");
  bushing.damping = matrix_of(table, "damping", "*s");
  assembly.model.forces.add(std::move(bushing));
  table.finish();
}

using SectionStiffness = multibody::Section::Stiffness;

/// Reads rows of three, one for each gap; zero if the key is absent.
Eigen::MatrixXd gap_rows(const StudyTable& table, const std::string& key, const std::string& unit,
                         Eigen::Index gaps) {
  if (!table.has(key)) return Eigen::MatrixXd::Zero(gaps, 3);
  const std::vector<double> values =
      table.quantities(key, static_cast<std::size_t>(3 * gaps), unit);
  return Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>>(values.data(),
                                                                                     gaps, 3);
}

/// Appends rows and columns of the gaps to the stiffness of the motions.
SectionStiffness with_gaps(const StudyTable& table, const Matrix6d& motions) {
  if (!table.has("gap_stiffness")) {
    table.refuse_given({"gap_translation_coupling", "gap_rotation_coupling"},
                       "has no effect without gap_stiffness");
    return motions;
  }
  const std::vector<double> values = table.quantities("gap_stiffness", 0, "N/m");
  const auto gaps = static_cast<Eigen::Index>(std::lround(std::sqrt(values.size())));
  if (gaps * gaps != static_cast<Eigen::Index>(values.size()) || gaps < 1 ||
      gaps > multibody::Section::kMaxGaps)
    table.refuse("gap_stiffness",
                 "expected a square matrix of one to four gaps row by row, found " +
                     std::to_string(values.size()) + " numbers");
  SectionStiffness stiffness = SectionStiffness::Zero(6 + gaps, 6 + gaps);
  stiffness.topLeftCorner<6, 6>() = motions;
  stiffness.bottomRightCorner(gaps, gaps) =
      Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
          values.data(), gaps, gaps);
  stiffness.bottomLeftCorner(gaps, 6) << gap_rows(table, "gap_translation_coupling", "N/m", gaps),
      gap_rows(table, "gap_rotation_coupling", "N/rad", gaps);
  stiffness.topRightCorner(6, gaps) = stiffness.bottomLeftCorner(gaps, 6).transpose();
  return stiffness;
}

fe_modal::CondensedSection condensed(const StudyTable& table, const std::string& key,
                                     fe_modal::Sliding sliding) {
  const std::filesystem::path path = modes_path(table, key);
  return at_key(table, key, [&] {
    return fe_modal::condense(read_modal_body(path).body, table.text("base"), table.text("top"),
                              sliding);
  });
}

/// The relaxing part of the stiffness.
SectionStiffness relaxing_part(const StudyTable& table, const multibody::Section& quick,
                               double shares) {
  if (!table.has("slow_modes_file")) return shares * quick.stiffness;
  const fe_modal::CondensedSection slow = condensed(table, "slow_modes_file", sliding_of(quick));
  const Eigen::Index size = slow.stiffness.rows() - 6;
  if ((slow.top_m - slow.base_m - quick.rest_m).norm() > 1e-9 * quick.rest_m.norm() ||
      size != quick.stiffness.rows())
    table.refuse("slow_modes_file",
                 "expected the length and the number of slit openings of modes_file, found others");
  return quick.stiffness - slow.stiffness.bottomRightCorner(size, size);
}

multibody::LoadCurve bending_curve(const StudyTable& table) {
  if (!table.has("bending_angles")) {
    table.refuse_given({"bending_moments"}, "has no effect without bending_angles");
    return {};
  }
  const std::vector<double> angles = table.quantities("bending_angles");
  return at_key(table, "bending_moments", [&] {
    return multibody::LoadCurve::table(angles, table.quantities("bending_moments", angles.size()));
  });
}

multibody::SlitFriction read_friction(const StudyTable& table) {
  const double coefficient = table.number("slit_friction");
  if (!(coefficient > 0))
    table.refuse_given({"slit_sliding_time"}, "has no effect without slit_friction, which is 0");
  return {0, coefficient, table.quantity("slit_sliding_time")};
}

/// Reads the section's stiffness from the source that its table names; that of a submesh is set
/// later.
void read_stiffness(const StudyTable& table, std::size_t index, Assembly& assembly) {
  const std::vector<std::string> own = {
      "length",        "translation_stiffness",    "rotation_stiffness",   "coupling_stiffness",
      "gap_stiffness", "gap_translation_coupling", "gap_rotation_coupling"};
  const Relaxation relaxation = read_relaxation(table);
  if (table.has("slow_modes_file") && relaxation.times_s.empty())
    table.refuse("slow_modes_file", "has no effect without relaxation_times or relaxation_law");
  if (!relaxation.times_s.empty()) assembly.relaxations.emplace(index, relaxation);
  if (table.has("piece")) {
    table.refuse_given(own, "the substructure given by piece determines it already");
    table.refuse_given({"modes_file", "slow_modes_file", "made_by"},
                       "expected a piece or files, found both");
    if (!assembly.structure)
      table.refuse("piece", "expected modes_file: only a study with [substructures] has pieces");
    assembly.of_pieces.push_back(
        {index, table.text("piece"), table.text("base"), table.text("top"), relaxation, table});
    return;
  }
  if (table.has("modes_file")) {
    table.refuse_given(own, "modes_file determines it already");
    const multibody::Section& section = assembly.model.forces.of<multibody::Section>()[index];
    use_condensed(condensed(table, "modes_file", sliding_of(section)), table, "modes_file", index,
                  assembly);
  } else {
    table.refuse_given({"base", "top", "slow_modes_file", "made_by", "slit_friction"},
                       "has no effect without modes_file");
    if (!table.has("length"))
      table.refuse("length", "expected length and stiffness, or modes_file");
    multibody::Section& section = assembly.model.forces.of<multibody::Section>()[index];
    section.rest_m = quantity_vector(table, "length");
    section.stiffness = with_gaps(table, matrix_of(table, "stiffness", ""));
  }
  multibody::Section& section = assembly.model.forces.of<multibody::Section>()[index];
  relaxation.apply(relaxing_part(table, section, relaxation.sum_of_shares()), section);
}

void read_section(const StudyTable& table, Assembly& assembly) {
  multibody::Section section;
  section.name = table.text("name");
  section.marker_i = marker_named(table, "lower", assembly);
  section.marker_j = marker_named(table, "upper", assembly);
  section.bending_curve = bending_curve(table);
  section.friction = read_friction(table);
  assembly.model.forces.add(std::move(section));
  read_stiffness(table, assembly.model.forces.of<multibody::Section>().size() - 1, assembly);
  table.finish();
}

}  // namespace

ModelSection bushing_section() {
  return {Key::tables(
              "bushing",
              "Bushings: linear springs and dampers between two markers in six degrees of freedom",
              kBushingKeys),
          read_bushing};
}

ModelSection elastic_section() {
  return {
      Key::tables("section", "Sections: slender elastic or viscoelastic parts between two markers",
                  kSectionKeys),
      read_section};
}

}  // namespace flexneck::pipeline
