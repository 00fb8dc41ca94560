// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesher/mesh/mesh.h"
#include "pipeline/language/study/study.h"

namespace flexneck::pipeline {

/// Adds the supports, couplings and loads of [modes] to the mesh's connections. With
/// modes.deck_supports = false the supports from the mesh's file are removed.
/// @throws InputError naming the key, with the nearest set if one is unknown.
void add_study_connections(const Study& study, mesher::Mesh& mesh);

}  // namespace flexneck::pipeline
