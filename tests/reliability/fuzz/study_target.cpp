// SPDX-License-Identifier: GPL-3.0-or-later
// Target: studies. The shipped parameters of the neck and a table lie beside the file.
#include <algorithm>
#include <cmath>
#include <set>

#include "pipeline/language/study/study.h"
#include "tests/reliability/fuzz/input_folder.h"

using namespace flexneck;

namespace {

class StudyFolder : public fuzz::InputFolder {
 public:
  StudyFolder() {
    for (const char* const name : {"hybrid3_common.toml", "hybrid3_c.toml"})
      std::filesystem::copy(std::filesystem::path(FLEXNECK_SOURCE_DIR) / "geometry" / name, path());
    static_cast<void>(with("pulse.csv", "time [ms], acceleration [gn]\n0, 0\n5, 4\n20, 0\n"));
  }
};

template <class Sections>
void check_names(const Sections& sections) {
  std::set<std::string> names;
  for (const auto& section : sections)
    fuzz::require(!section.name.empty() && names.insert(section.name).second,
                  "names are given once");
}

void check_increasing(const std::vector<double>& times, std::size_t values) {
  fuzz::require(times.size() == values, "a table has a value at each time");
  fuzz::require(std::all_of(times.begin(), times.end(), [](double t) { return std::isfinite(t); }),
                "times are finite");
  fuzz::require(
      std::adjacent_find(times.begin(), times.end(), std::greater_equal<>()) == times.end(),
      "times increase strictly");
}

void check(const pipeline::Assembly& assembly) {
  for (const auto& body : assembly.model.bodies) {
    const auto* const rigid = std::get_if<multibody::RigidBody>(&body.kind);
    fuzz::require(
        rigid == nullptr || (std::isfinite(rigid->mass_kg) && rigid->center_m.allFinite() &&
                             rigid->inertia_kg_m2.allFinite()),
        "a body is finite");
  }
  for (const auto& [ignored, use] : assembly.of_structure)
    fuzz::require(std::isfinite(use.damping_ratio.value_or(0)), "damping is finite");
  for (const auto& marker : assembly.model.markers)
    fuzz::require(marker.position_m.allFinite(), "a marker is somewhere");
  for (const auto& joint : assembly.model.joints)
    fuzz::require(std::abs(joint.axis.norm() - 1) < 1e-9, "an axis is a unit vector");
  for (const auto& force : assembly.model.forces.of<multibody::PointForce>())
    fuzz::require(std::abs(force.direction.norm() - 1) < 1e-9, "a direction is a unit vector");
}

void check(const pipeline::Study& study) {
  check_names(study.model.model.bodies);
  check_names(study.model.model.markers);
  check_names(study.model.model.joints);
  check_names(study.pulses);
  check_names(study.cases);
  check(study.model);
  for (const auto& pulse : study.pulses)
    check_increasing(pulse.times_s, pulse.deceleration_m_s2.size());
  for (const auto& experiment : study.cases) {
    check(experiment.model);
    fuzz::require(std::isfinite(experiment.duration_s) && experiment.duration_s > 0 &&
                      std::isfinite(experiment.impact_velocity_m_s),
                  "a case has a duration and a velocity");
  }
  fuzz::require(study.solver.relative_tolerance > 0 && study.output_interval_s > 0,
                "tolerances and intervals are positive");
  fuzz::require(!study.files.empty(), "the files of a study are known");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const StudyFolder folder;
  const std::string text = fuzz::text_of(data, size);
  return fuzz::try_reader(
      [&] { check(pipeline::read_study(folder.with("study.toml", text), {})); });
}
