// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesher/exchange/import_options.h"
#include "pipeline/language/study/study.h"

namespace flexneck::pipeline {

/// Options for reading the study's file. @pre study.structure is of a file, not of a script
mesher::ImportOptions import_options_of(const Study& study);

}  // namespace flexneck::pipeline
