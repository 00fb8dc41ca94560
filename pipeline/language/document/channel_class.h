// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "multibody/signals/cfc_filter.h"
#include "pipeline/language/document/study_document.h"

namespace flexneck::pipeline {

/// Names "CFC 60" to "CFC 1000": the choices of a key for a filter.
std::vector<std::string> channel_class_names();

/// Reads the class that a key for a filter chooses.
multibody::ChannelClass read_channel_class(const StudyTable& table, const std::string& key);

}  // namespace flexneck::pipeline
