// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <vector>

#include "geometry/neck/neck_parameters.h"
#include "geometry/neck/neck_slits.h"
#include "mesher/gmsh/script_mesher.h"
#include "pipeline/language/document/study_document.h"

namespace flexneck::pipeline {

/// Data in [geometry] and [mesh] of a script that draws the neck: its dimensions, from which the
/// script's constants follow.
struct NeckSection {
  geometry::NeckParameters dimensions;
  geometry::NeckDivisions divisions;
  geometry::NeckSlits slits;
  std::vector<std::string> fitted_to;  ///< published figures that the dimensions were fitted to
  std::string fitted_values;  ///< neck_values_hash() of that fit; empty for a fit made by hand
};

// Keys of [geometry] and of [mesh] of such a script besides those of every script.
std::span<const Key> neck_geometry_keys();
std::span<const Key> neck_mesh_keys();

/// Returns whether [geometry] gives dimensions of the neck.
bool has_neck(const StudyTable& geometry);
NeckSection read_neck(const StudyTable& geometry, const StudyTable& mesh);

/// Adds data that follow from the neck: the script's constants, slits and the node set "bolts". The
/// element must be known.
void add_neck(const NeckSection& neck, mesher::ScriptMeshOptions& options);

/// Checks that the neck can be built, and that the study fixes its base.
/// @throws InputError with the condition that fails.
void check_neck(const StudyTable& root, const NeckSection& neck);

/// The key of the first dimension or material that is the user's own (synthetic), for any
/// structure; empty if all are declared published, inferred from published data, or calibrated.
std::string own_value_of_geometry(const std::vector<Parameter>& parameters);

/// Hash of the values on which a fit of the neck depends: all of [geometry], materials too, except
/// the script, slits and the keys about the fit; and the position of the head's joint.
/// @param parameters  all parameters of the study
std::string neck_values_hash(const std::vector<Parameter>& parameters);

/// Clears `fitted_to` if the neck is no longer the one that was fitted: by the hash if the fit
/// gives one; otherwise if a value comes from another folder or is the user's own.
/// @param parameters  all parameters of the study
void forget_fit_of_changed_neck(const StudyTable& root, const std::vector<Parameter>& parameters,
                                NeckSection& neck);

}  // namespace flexneck::pipeline
