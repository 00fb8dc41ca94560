// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/language/document/channel_class.h"

#include <array>

namespace flexneck::pipeline {

using multibody::ChannelClass;

namespace {

constexpr std::array kClasses = {ChannelClass::cfc60, ChannelClass::cfc180, ChannelClass::cfc600,
                                 ChannelClass::cfc1000};

}  // namespace

std::vector<std::string> channel_class_names() {
  std::vector<std::string> names;
  names.reserve(kClasses.size());
  for (const ChannelClass each : kClasses) names.push_back(name_of(each));
  return names;
}

ChannelClass read_channel_class(const StudyTable& table, const std::string& key) {
  return kClasses.at(table.choice(key));
}

}  // namespace flexneck::pipeline
