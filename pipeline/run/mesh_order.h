// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/language/study/study.h"
#include "pipeline/run/remembered_study.h"

namespace flexneck::pipeline {

/// Request to the program flexneck-mesher: studies, and a folder for their meshes.
struct MeshOrder {
  std::filesystem::path folder;
  std::vector<StudyChoice> studies;
};

MeshOrder mesh_order(const std::filesystem::path& folder, const std::vector<const Study*>& studies);

/// Converts a request to arguments of a task, and back.
std::vector<std::string> arguments_of(const MeshOrder& order);
MeshOrder order_from(const std::vector<std::string>& arguments);

/// Paths of a study's result: a mesh file, or a text with the reason of a refusal.
std::filesystem::path mesh_result(const MeshOrder& order, std::size_t place);
std::filesystem::path refusal_result(const MeshOrder& order, std::size_t place);

}  // namespace flexneck::pipeline
