// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

namespace flexneck::pipeline {

/// The pictures that `flexneck sweep` has left in a folder, for the page; empty if there are none.
std::string sweep_pictures_html(const std::filesystem::path& folder);
/// Those that `flexneck fit` has left.
std::string fit_pictures_html(const std::filesystem::path& folder);
/// mesh.png of a folder, for readers whose browser shows no motion; empty if it is not there.
std::string mesh_picture_html(const std::filesystem::path& folder, const std::string& label);

}  // namespace flexneck::pipeline
