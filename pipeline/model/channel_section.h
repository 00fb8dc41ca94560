// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "multibody/model/model.h"
#include "pipeline/document/study_document.h"
#include "pipeline/model/channel.h"

namespace flexneck::pipeline {

/// One [[channel]].
/// @param interval_s  of the output: a filter needs it short enough
/// @throws InputError with file, line, column and key.
std::span<const Key> channel_keys();
ChannelSpec read_channel(const StudyTable& table, multibody::Model& model, double interval_s);

}  // namespace flexneck::pipeline
