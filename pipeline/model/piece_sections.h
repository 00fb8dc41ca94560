// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <map>
#include <string>

#include "fe_modal/body/condensed_section.h"
#include "fe_modal/body/modal_body.h"
#include "multibody/forces/section.h"
#include "pipeline/document/study_document.h"
#include "pipeline/model/relaxation.h"

namespace flexneck::pipeline {

struct Assembly;

/// How a [[section]] uses a piece of the structure whose modes are known later.
struct PieceUse {
  std::size_t section = 0;  ///< among the model's
  std::string piece, base, top;
  Relaxation relaxation;
  StudyTable table;  ///< that says so; for messages
};

/// Modes of the structure's pieces, by their names.
using Pieces = std::map<std::string, fe_modal::ModalBody>;

/// Stiffness and length of a condensed piece become a section's, and its mass, lumped at its ends,
/// joins the bodies there that have their mass of sections.
/// @throws InputError at the key for more openings of slits than a section has gaps
void use_condensed(const fe_modal::CondensedSection& piece, const StudyTable& table,
                   const std::string& key, std::size_t section, Assembly& assembly);

/// Kept where the section has a coefficient of friction.
fe_modal::Sliding sliding_of(const multibody::Section& section);

/// Gives the sections that are pieces of the structure their stiffness.
/// @throws InputError for a piece that is not there or is no section.
void attach_pieces(const Pieces& pieces, Assembly& assembly);

}  // namespace flexneck::pipeline
