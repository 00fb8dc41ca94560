// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <map>

#include "multibody/model/model.h"
#include "pipeline/model/relaxation.h"
#include "pipeline/output/result_table.h"
#include "pipeline/study/study.h"

namespace flexneck::pipeline {

/// "relaxation": storage modulus and loss factor against frequency of the sections that relax in
/// the pendulum's cases, what their branches were fitted to and where they stand for the rubber. No
/// rows where nothing relaxes.
/// @param study  its sections with their stiffness
ResultTable relaxation_table(const Study& study);
/// The same of a model's sections that relax.
ResultTable relaxation_table(const multibody::Model& model,
                             const std::map<std::size_t, Relaxation>& relaxations);

}  // namespace flexneck::pipeline
