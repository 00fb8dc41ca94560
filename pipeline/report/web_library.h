// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>

#include <nlohmann/json_fwd.hpp>

namespace flexneck::pipeline {

/// A script that a Debian package installs for web pages.
enum class WebLibrary { d3, three };

/// Its source. @throws InputError with the package's name if it is not installed.
std::string source_of(WebLibrary library);

/// A part of our own pages, from pipeline/report/page. @throws InputError if it is not there.
std::string page_part(const std::string& name);

/// What every page of ours has between <head> and </head>. @param title  as HTML
std::string page_head(const std::string& title);

/// Of the section with the warnings.
inline constexpr const char* kWarningsTitle = "⚠ Read before you use the results";

/// Adds a section to texts["sections"], and to texts["navigation"] its link. One without content is
/// left out. @param link, title  as HTML
void add_section(const std::string& id, const std::string& link, const std::string& title,
                 const std::string& content, std::map<std::string, std::string>& texts);

/// What the scripts of a page read: units, curves, and each scene with its label.
std::string page_data(const nlohmann::ordered_json& scenes, const nlohmann::ordered_json& curves);

/// All scripts of a page, the libraries as far as they are needed.
std::string page_scripts(bool with_scenes, bool with_curves);

/// A script in an element of its own.
std::string script_element(const std::string& source);

}  // namespace flexneck::pipeline
