// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>

#include <nlohmann/json_fwd.hpp>

namespace flexneck::pipeline {

/// A script that a Debian package installs for web pages.
enum class WebLibrary { d3, three };

/// Source of a library. @throws InputError with the package's name if it is not installed.
std::string source_of(WebLibrary library);

/// A part of flexneck's pages, from pipeline/results/report/page. @throws InputError if it does not
/// exist.
std::string page_part(const std::string& name);

/// Content of <head> for every page of flexneck. @param title  as HTML
std::string page_head(const std::string& title);

/// Title of the section with the warnings.
inline constexpr const char* kWarningsTitle = "⚠ Read before you use the results";

/// Adds a section to texts["sections"], and its link to texts["navigation"]. A section without
/// content is left out. @param link, title  as HTML
void add_section(const std::string& id, const std::string& link, const std::string& title,
                 const std::string& content, std::map<std::string, std::string>& texts);

/// Data that the scripts of a page read: units, curves, and each scene with its label.
std::string page_data(const nlohmann::ordered_json& scenes, const nlohmann::ordered_json& curves);

/// All scripts of a page, including the libraries that it needs.
std::string page_scripts(bool with_scenes, bool with_curves);

/// A script in a <script> element.
std::string script_element(const std::string& source);

}  // namespace flexneck::pipeline
