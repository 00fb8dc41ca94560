// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace flexneck::pipeline {

/// A script that a Debian package installs for web pages.
enum class WebLibrary { d3, three };

/// Its source. @throws InputError with the package's name if it is not installed.
std::string source_of(WebLibrary library);

/// A part of our own pages, from pipeline/report/page. @throws InputError if it is not there.
std::string page_part(const std::string& name);

/// What every page of ours has between <head> and </head>. @param title  as HTML
std::string page_head(const std::string& title);

/// A script in an element of its own.
std::string script_element(const std::string& source);

}  // namespace flexneck::pipeline
