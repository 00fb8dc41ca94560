// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <map>
#include <string>

#include "fe_modal/body/condensed_section.h"
#include "fe_modal/body/modal_body.h"
#include "multibody/forces/section.h"
#include "pipeline/language/document/study_document.h"
#include "pipeline/language/model/relaxation.h"

namespace flexneck::pipeline {

struct Assembly;

/// Use of a submesh of the structure by a [[section]], read before its modes are known.
struct PieceUse {
  std::size_t section = 0;  ///< index among the model's sections
  std::string piece, base, top;
  Relaxation relaxation;
  StudyTable table;  ///< the section's table, for messages
};

/// Modes of the structure's submeshes, keyed by name.
using Pieces = std::map<std::string, fe_modal::ModalBody>;

/// Gives a section the stiffness and length of a condensed submesh, and adds the submesh's mass,
/// lumped at its ends, to the bodies there whose mass is that of sections.
/// @throws InputError at the key if the slits have more opening coordinates than a section has gaps
void use_condensed(const fe_modal::CondensedSection& piece, const StudyTable& table,
                   const std::string& key, std::size_t section, Assembly& assembly);

/// Sliding coordinates are kept if the section has a coefficient of friction.
fe_modal::Sliding sliding_of(const multibody::Section& section);

/// Gives the sections that are submeshes of the structure their stiffness.
/// @throws InputError for a submesh that does not exist or cannot be a section.
void attach_pieces(const Pieces& pieces, Assembly& assembly);

}  // namespace flexneck::pipeline
