// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/folder/remembered_study.h"
#include "pipeline/study/study.h"

namespace flexneck::pipeline {

/// What flexneck asks of the program flexneck-mesher: studies, and a folder for a mesh of each.
struct MeshOrder {
  std::filesystem::path folder;
  std::vector<StudyChoice> studies;
};

MeshOrder mesh_order(const std::filesystem::path& folder, const std::vector<const Study*>& studies);

/// The order as arguments of a task, and back.
std::vector<std::string> arguments_of(const MeshOrder& order);
MeshOrder order_from(const std::vector<std::string>& arguments);

/// What comes of the study at a place: a mesh file, or the text that refuses its file or script.
std::filesystem::path mesh_result(const MeshOrder& order, std::size_t place);
std::filesystem::path refusal_result(const MeshOrder& order, std::size_t place);

}  // namespace flexneck::pipeline
