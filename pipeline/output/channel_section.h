// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "multibody/model.h"
#include "pipeline/output/channel.h"
#include "pipeline/study/study_document.h"

namespace flexneck::pipeline {

/// One [[channel]].
/// @param interval_s  of the output: a filter needs it short enough
/// @throws InputError with file, line, column and key.
ChannelSpec read_channel(const StudyTable& table, const multibody::Model& model, double interval_s);

}  // namespace flexneck::pipeline
