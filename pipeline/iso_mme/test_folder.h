// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "pipeline/iso_mme/channel_file.h"

namespace flexneck::pipeline {

/// Whether a path names a test of ISO/TS 13499 by what is read there: a folder, <test>.mme,
/// <test>.chn or the file of a channel, <test>.001, capitals or not.
bool names_mme_test(const std::filesystem::path& path);

/// A channel of a test and the file that it is in.
struct FoundMmeChannel {
  std::filesystem::path file;
  MmeChannel channel;
};

/// Reads a channel of the test that a path names; the index <test>.chn is in the folder Channel
/// beside <test>.mme, or beside it itself.
/// @param code  of the channel; may be empty if the test has one only, or the path is its file
/// @throws InputError as read_mme_channel_file() does, for a folder without a test or with several,
/// an index that does not say which channels there are, and a code that is not there, with the
/// nearest and all that are.
FoundMmeChannel read_mme_channel(const std::filesystem::path& path, const std::string& code);

}  // namespace flexneck::pipeline
