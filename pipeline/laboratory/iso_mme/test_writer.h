// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/laboratory/iso_mme/channel_file.h"

namespace flexneck::pipeline {

/// A test as <test>.mme describes it. Laboratory and date are left out: the same channels make the
/// same files.
struct MmeTest {
  std::string title;
  std::string type;                   ///< text of "Type of the test"
  std::string object;                 ///< text of "Name of test object 1"
  std::vector<std::string> comments;  ///< one line each
  std::vector<MmeChannel> channels;   ///< at most 999, with different codes
};

/// Writes the folder <test>/ with <test>.mme, the index Channel/<test>.chn and a file for each
/// channel, Channel/<test>.001 and so on, all of them or none. A test of that name is replaced.
/// @param path  <test>/<test>.mme
/// @throws InputError for another path, a folder that holds other files, and too many channels.
void write_mme_test(const std::filesystem::path& path, const MmeTest& test);

}  // namespace flexneck::pipeline
