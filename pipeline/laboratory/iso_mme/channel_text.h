// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "pipeline/laboratory/iso_mme/channel_file.h"

namespace flexneck::pipeline {

/// Line "Key                         :value", the key padded to 28 characters; NOVALUE for none.
std::string mme_line(std::string_view key, std::string_view value);

/// The text of a channel's file, whose numbers are read back exactly.
std::string mme_channel_text(const MmeChannel& channel);

}  // namespace flexneck::pipeline
