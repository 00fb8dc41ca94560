// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <vector>

#include "geometry/neck/neck_parameters.h"
#include "geometry/neck/neck_slits.h"
#include "mesher/gmsh/script_mesher.h"
#include "pipeline/document/study_document.h"

namespace flexneck::pipeline {

/// What [geometry] and [mesh] say of a script that draws the neck: its dimensions, from which its
/// constants follow.
struct NeckSection {
  geometry::NeckParameters dimensions;
  geometry::NeckDivisions divisions;
  geometry::NeckSlits slits;
  std::vector<std::string> fitted_to;  ///< published figures that the dimensions were fitted to
  std::string fitted_values;  ///< neck_values_hash() of that fit; empty of one made by hand
};

// Keys of [geometry] and of [mesh] that such a script has besides those of every script.
std::span<const Key> neck_geometry_keys();
std::span<const Key> neck_mesh_keys();

/// Whether [geometry] gives dimensions of the neck.
bool has_neck(const StudyTable& geometry);
NeckSection read_neck(const StudyTable& geometry, const StudyTable& mesh);

/// What follows from the neck: the script's constants, slits and the node set "bolts". The element
/// must be known.
void add_neck(const NeckSection& neck, mesher::ScriptMeshOptions& options);

/// Whether the neck can be built, and whether the study says what it stands on.
/// @throws InputError with the condition that fails.
void check_neck(const StudyTable& root, const NeckSection& neck);

/// The key of the first dimension or material that is the user's own (synthetic), of any structure;
/// empty if all claim to be published, inferred from that, or calibrated.
std::string own_value_of_geometry(const std::vector<Parameter>& parameters);

/// Hash of the values that a fit of the neck is made with: all of [geometry], materials too, but
/// for the script, slits and what names the fit; and where the head's joint is.
/// @param parameters  of the whole study
std::string neck_values_hash(const std::vector<Parameter>& parameters);

/// Clears `fitted_to` where the neck is no longer the one that was fitted: by the hash where the
/// fit gives one; otherwise where a value comes from another folder or is the user's own.
/// @param parameters  of the whole study
void forget_fit_of_changed_neck(const StudyTable& root, const std::vector<Parameter>& parameters,
                                NeckSection& neck);

}  // namespace flexneck::pipeline
