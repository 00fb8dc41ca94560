// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/parameter_studies/evaluation/pieces_of_cases.h"

#include <algorithm>

#include "geometry/foundation/error.h"

namespace flexneck::pipeline {

bool has_cases_of_pieces(const Study& study) {
  return has_cases_of_pieces(study, CaseSection::Kind::pendulum) ||
         has_cases_of_pieces(study, CaseSection::Kind::static_test);
}

bool has_cases_of_pieces(const Study& study, CaseSection::Kind kind) {
  return std::any_of(study.cases.begin(), study.cases.end(), [&](const CaseSection& each) {
    return each.kind == kind && !each.model.of_pieces.empty();
  });
}

Study with_pieces(Study study, const Pieces& pieces) {
  for (CaseSection& experiment : study.cases) {
    try {
      attach_pieces(pieces, experiment.model);
    } catch (const InputError& error) {
      throw InputError("case." + experiment.name + ": " + error.what());
    }
  }
  return study;
}

}  // namespace flexneck::pipeline
