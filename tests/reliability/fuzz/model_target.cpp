// SPDX-License-Identifier: GPL-3.0-or-later
// Target: models. A table, the file of an assembly and the modes of a body lie beside the file.
#include <cmath>

#include "fe_modal/body/modal_body_file.h"
#include "pipeline/language/model/model_file.h"
#include "tests/reliability/fuzz/input_folder.h"
#include "tests/support/point_mass_body.h"

using namespace flexneck;

namespace {

const std::string kPart = R"(
[[body]]
name = "part"
kind = "rigid"
mass = "1 kg"
center = ["0 m", "0 m", "0 m"]
inertia = ["1 kg*m^2", "1 kg*m^2", "1 kg*m^2"]
position = ["$side*1 m", "0 m", "0 m"]
[variables]
side = 1
)";

class ModelFolder : public fuzz::InputFolder {
 public:
  ModelFolder() {
    static_cast<void>(with("pulse.csv", "time [ms], acceleration [gn]\n0, 0\n5, 4\n20, 0\n"));
    static_cast<void>(with("part.toml", kPart));
    fe_modal::ModalBodyFile modes;
    modes.body = testing::make_point_mass_body(1, 2, 5).body;
    fe_modal::write_modal_body(path() / "modes.h5", modes);
  }
};

void check(const pipeline::ModelFile& file) {
  const multibody::Model& model = file.model;
  multibody::check(model);
  for (const multibody::Body& body : model.bodies) {
    const multibody::Pose& pose = body.initial_pose;
    fuzz::require(pose.position_m.allFinite() && std::abs(pose.rotation.norm() - 1) < 1e-9,
                  "a body has a pose");
    fuzz::require(
        body.initial_velocity_m_s.allFinite() && body.initial_angular_velocity_rad_s.allFinite(),
        "a body has velocities");
  }
  for (const multibody::Marker& marker : model.markers)
    fuzz::require(marker.body < model.bodies.size(), "a marker is on a body");
  for (const multibody::Joint& joint : model.joints)
    fuzz::require(joint.marker_i < model.markers.size() && joint.marker_j < model.markers.size(),
                  "a joint has two markers");
  fuzz::require(model.gravity_m_s2.allFinite(), "gravity is finite");
  fuzz::require(file.end_time_s > 0 && std::isfinite(file.end_time_s), "a run has an end");
  fuzz::require(file.output.interval_s > 0 && std::isfinite(file.output.interval_s),
                "outputs have an interval");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const ModelFolder folder;
  const std::string text = fuzz::text_of(data, size);
  return fuzz::try_reader(
      [&] { check(pipeline::read_model_file(folder.with("model.toml", text), {})); });
}
