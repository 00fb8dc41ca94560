// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/run/import_options.h"

#include <variant>

namespace flexneck::pipeline {

mesher::ImportOptions import_options_of(const Study& study) {
  auto options = std::get<mesher::ImportOptions>(study.structure->source);
  options.is_reduced = study.modes.formulation == fe_modal::Formulation::reduced;
  return options;
}

}  // namespace flexneck::pipeline
