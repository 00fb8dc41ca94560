// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "pipeline/laboratory/iso_mme/channel_file.h"

namespace flexneck::pipeline {

/// Returns whether a path names a test of ISO/TS 13499: a folder, <test>.mme, <test>.chn or the
/// file of a channel, <test>.001, in upper or lower case.
bool names_mme_test(const std::filesystem::path& path);

/// A channel of a test and the file that it is in.
struct FoundMmeChannel {
  std::filesystem::path file;
  MmeChannel channel;
};

/// Reads a channel of the test that a path names; the index <test>.chn is in the folder Channel
/// beside <test>.mme, or directly beside it.
/// @param code  code of the channel; may be empty if the test has only one, or the path is its file
/// @throws InputError as read_mme_channel_file() does, for a folder without a test or with several,
/// an index that lists no channels, and a code that is not present, with the nearest and all codes.
FoundMmeChannel read_mme_channel(const std::filesystem::path& path, const std::string& code);

}  // namespace flexneck::pipeline
