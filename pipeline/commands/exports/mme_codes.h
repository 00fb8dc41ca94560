// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "multibody/files/history_file.h"
#include "pipeline/iso_mme/channel_file.h"
#include "pipeline/study/study.h"

namespace flexneck::pipeline {

/// Whose channels a run's are.
struct MmeSource {
  const CaseSection* experiment = nullptr;  ///< null: a model file's
  std::string dummy;                        ///< as the study names it
};

/// The code of each curve of a channel. Those of a case's channels are a table (mme_codes.cpp); a
/// channel whose name is a code of its own dimension and filter keeps it; any other has the code of
/// a laboratory, 00 2nnn 000000 with the running number nnn.
/// @param number  of the last code of a laboratory, which goes on
/// @throws InputError for more than 999 of those.
std::vector<std::string> mme_codes(const multibody::Channel& channel, const MmeSource& source,
                                   int& number);

/// The channels of a run in SI units, sample by sample as the run has them.
/// @param left_out  gets a line for what is not carried over: a last output at a shorter interval
/// @throws InputError for outputs that are not at equal intervals.
std::vector<MmeChannel> mme_channels(const multibody::HistoryFile& run, const MmeSource& source,
                                     std::vector<std::string>& left_out);

}  // namespace flexneck::pipeline
