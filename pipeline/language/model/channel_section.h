// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "multibody/model/model.h"
#include "pipeline/language/document/study_document.h"
#include "pipeline/language/model/channel.h"

namespace flexneck::pipeline {

/// Keys of a [[channel]].
std::span<const Key> channel_keys();
/// Reads one [[channel]].
/// @param interval_s  interval of the output; a filter needs it short enough
/// @throws InputError with file, line, column and key.
ChannelSpec read_channel(const StudyTable& table, multibody::Model& model, double interval_s);

}  // namespace flexneck::pipeline
