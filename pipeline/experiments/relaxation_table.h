// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <map>

#include "multibody/model/model.h"
#include "pipeline/language/model/relaxation.h"
#include "pipeline/language/study/study.h"
#include "pipeline/process/result_table.h"

namespace flexneck::pipeline {

/// Table "relaxation": storage modulus and loss factor against frequency of the sections that relax
/// in the pendulum's cases, the data that their branches were fitted to, and the materials that
/// they represent. No rows if nothing relaxes.
/// @param study  the study, its sections with their stiffness
ResultTable relaxation_table(const Study& study);
/// Table of the relaxing sections of a model.
ResultTable relaxation_table(const multibody::Model& model,
                             const std::map<std::size_t, Relaxation>& relaxations);

}  // namespace flexneck::pipeline
