// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/laboratory/iso_mme/channel_text.h"

#include <algorithm>

#include "geometry/foundation/output_file.h"
#include "pipeline/laboratory/iso_mme/channel_code.h"

namespace flexneck::pipeline {

std::string mme_line(std::string_view key, std::string_view value) {
  constexpr std::size_t kKeyLength = 28;
  std::string line(key);
  line.resize(std::max(kKeyLength, line.size()), ' ');
  return line + ":" + std::string(value.empty() ? "NOVALUE" : value) + "\n";
}

std::string mme_channel_text(const MmeChannel& channel) {
  const std::string& code = channel.code;
  const auto passed = mme_filter(code).passed;
  Eigen::Index high = 0;
  Eigen::Index low = 0;
  const double largest = channel.values.maxCoeff(&high);
  const double least = channel.values.minCoeff(&low);
  const auto time = [&](Eigen::Index k) {
    return exact_text(channel.first_s + static_cast<double>(k) * channel.interval_s);
  };
  std::string text = mme_line("Channel code", code) + mme_line("Reference channel", "implicit") +
                     mme_line("Reference channel name", "") +
                     mme_line("Data source", "simulation") + mme_line("Test object number", "1") +
                     mme_line("Name of the channel", channel.name) + mme_line("Location", code) +
                     mme_line("Direction", code.substr(14, 1)) +
                     mme_line("Channel frequency class",
                              passed ? std::to_string(static_cast<int>(*passed)) : std::string()) +
                     mme_line("Sampling interval", exact_text(channel.interval_s)) +
                     mme_line("Unit", unit_to_mme(channel.unit)) +
                     mme_line("Time of first sample", exact_text(channel.first_s)) +
                     mme_line("Number of samples", std::to_string(channel.values.size())) +
                     mme_line("First global maximum value", exact_text(largest)) +
                     mme_line("Time of maximum value", time(high)) +
                     mme_line("First global minimum value", exact_text(least)) +
                     mme_line("Time of minimum value", time(low)) +
                     mme_line("Dimension", code.substr(12, 2)) + mme_line("Data status", "ok");
  for (const double value : channel.values) text += exact_text(value) + "\n";
  return text;
}

}  // namespace flexneck::pipeline
