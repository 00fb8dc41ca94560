// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "pipeline/language/model/piece_sections.h"
#include "pipeline/language/study/study.h"

namespace flexneck::pipeline {

/// True if a case has submeshes of the structure as sections.
bool has_cases_of_pieces(const Study& study);
bool has_cases_of_pieces(const Study& study, CaseSection::Kind kind);

/// The study with the submeshes' stiffness. @throws InputError as attach_pieces() does, with the
/// case.
Study with_pieces(Study study, const Pieces& pieces);

}  // namespace flexneck::pipeline
