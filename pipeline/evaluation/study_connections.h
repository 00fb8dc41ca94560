// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesher/mesh/mesh.h"
#include "pipeline/study/study.h"

namespace flexneck::pipeline {

/// Adds what [modes] holds, joins and loads the structure with to the mesh's connections. With
/// modes.deck_supports = false the supports that the mesh has from its file go.
/// @throws InputError naming the key, with the nearest set where one is unknown.
void add_study_connections(const Study& study, mesher::Mesh& mesh);

}  // namespace flexneck::pipeline
