// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

namespace flexneck::pipeline {

/// HTML of the pictures by `flexneck sweep` in a folder; empty if there are none.
std::string sweep_pictures_html(const std::filesystem::path& folder);
/// HTML of the pictures by `flexneck fit` in a folder; empty if there are none.
std::string fit_pictures_html(const std::filesystem::path& folder);
/// HTML of a folder's mesh.png, for browsers that show no motion; empty if it does not exist.
std::string mesh_picture_html(const std::filesystem::path& folder, const std::string& label);

}  // namespace flexneck::pipeline
