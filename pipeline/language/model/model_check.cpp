// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/language/model/model_check.h"

#include "geometry/foundation/error.h"
#include "multibody/joints/fixed_joint.h"

namespace flexneck::pipeline {

using multibody::Joint;
using multibody::Model;
using multibody::PrescribedBody;

namespace {

bool is_prescribed(const Model& model, std::size_t body) {
  return std::holds_alternative<PrescribedBody>(model.bodies[body].kind);
}

void check_drives(const Model& model, std::size_t body) {
  const Joint* first = nullptr;
  std::size_t drive = 0;
  for (const Joint& joint : model.joints) {
    if (joint.kind->motion != &multibody::kFixedMotion) continue;
    const std::size_t i = model.markers[joint.marker_i].body;
    const std::size_t j = model.markers[joint.marker_j].body;
    if (i != body && j != body) continue;
    const std::size_t other = i == body ? j : i;
    if (!is_prescribed(model, other) || (first != nullptr && other == drive)) continue;
    if (first != nullptr)
      throw InputError("the motion of body '" + model.bodies[body].name +
                       "' is prescribed twice: joint '" + first->name + "' fixes it to '" +
                       model.bodies[drive].name + "' and joint '" + joint.name + "' to '" +
                       model.bodies[other].name + "'; remove one of them");
    first = &joint;
    drive = other;
  }
}

}  // namespace

void check_connections(const Assembly& assembly) {
  const Model& model = assembly.model;
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if (!is_prescribed(model, b) &&
        !std::holds_alternative<multibody::DeformableBody>(model.bodies[b].kind))
      check_drives(model, b);
}

}  // namespace flexneck::pipeline
