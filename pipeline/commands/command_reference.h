// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace flexneck::pipeline {

/// `flexneck --man`: the manual page in troff, of section 1, made of the table of commands and of
/// their options.
std::string man_page();

/// `flexneck --bash-completion`: what bash completes by, from the same tables and the names of the
/// shipped studies and models.
std::string bash_completion();

}  // namespace flexneck::pipeline
