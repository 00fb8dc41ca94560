// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "multibody/files/history_file.h"
#include "pipeline/laboratory/iso_mme/channel_file.h"
#include "pipeline/language/study/study.h"

namespace flexneck::pipeline {

/// Origin of a run's channels.
struct MmeSource {
  const CaseSection* experiment = nullptr;  ///< null for a model file
  std::string dummy;                        ///< name of the dummy in the study
};

/// The code of each curve of a channel. The codes of a case's channels are in a table
/// (mme_codes.cpp); a channel whose name is a code of its own dimension and filter keeps it; any
/// other gets a laboratory's code, 00 2nnn 000000 with the running number nnn.
/// @param number  number of the last laboratory's code; advanced by the codes given
/// @throws InputError for more than 999 laboratory's codes.
std::vector<std::string> mme_codes(const multibody::Channel& channel, const MmeSource& source,
                                   int& number);

/// The channels of a run in SI units, with the samples of the run.
/// @param left_out  gets a line for each loss: a last output at a shorter interval
/// @throws InputError for outputs at unequal intervals.
std::vector<MmeChannel> mme_channels(const multibody::HistoryFile& run, const MmeSource& source,
                                     std::vector<std::string>& left_out);

}  // namespace flexneck::pipeline
