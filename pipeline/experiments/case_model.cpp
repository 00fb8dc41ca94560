// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/experiments/case_model.h"

#include <optional>
#include <stdexcept>

#include "geometry/foundation/error.h"
#include "pipeline/experiments/rigid_neck.h"
#include "pipeline/language/model/model_check.h"
#include "pipeline/language/model/start_check.h"

namespace flexneck::pipeline {

using multibody::Model;

namespace {

/// Replaces the deformable neck by the rigid one.
void replace_neck(CaseSection::Direction direction, Model& model) {
  const std::size_t neck = deformable_body(model);
  put_rigid_neck(
      equivalent_neck(std::get<multibody::DeformableBody>(model.bodies[neck].kind), direction),
      direction, neck, model);
}

}  // namespace

std::size_t deformable_body(const Model& model) {
  std::optional<std::size_t> found;
  for (std::size_t k = 0; k < model.bodies.size(); ++k) {
    if (!std::holds_alternative<multibody::DeformableBody>(model.bodies[k].kind)) continue;
    if (found)
      throw InputError("expected one deformable body, found '" + model.bodies[*found].name +
                       "' and '" + model.bodies[k].name + "'");
    found = k;
  }
  if (!found) throw InputError("expected a deformable body, found none");
  return *found;
}

Model case_model(const CaseSection& experiment, const fe_modal::ModalBody& structure) {
  try {
    Assembly assembly = experiment.model;
    attach(structure, assembly);
    if (!assembly.of_pieces.empty())
      throw std::logic_error("case." + experiment.name + ": its sections have no stiffness yet");
    if (experiment.equivalent_rigid_neck) replace_neck(experiment.direction, assembly.model);
    check_connections(assembly);
    place_bodies(assembly.model, assembly.starts, assembly.posed);
    check_starts(assembly, "the case starts at rest");
    return std::move(assembly.model);
  } catch (const InputError& error) {
    throw InputError("case." + experiment.name + ": " + error.what());
  }
}

}  // namespace flexneck::pipeline
