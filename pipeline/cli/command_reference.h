// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace flexneck::pipeline {

/// Manual page in troff, section 1, for `flexneck --man`, made from the table of commands and their
/// options.
std::string man_page();

/// Completion script for bash, for `flexneck --bash-completion`, made from the same tables and the
/// names of the shipped studies and models.
std::string bash_completion();

}  // namespace flexneck::pipeline
