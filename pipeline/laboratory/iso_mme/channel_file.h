// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include <Eigen/Core>

namespace flexneck::pipeline {

/// A channel of a test: samples at equal intervals, sample k at first_s + k interval_s.
struct MmeChannel {
  std::string code;  ///< code of the channel (channel_code.h)
  std::string name;  ///< text of "Name of the channel"; may be empty
  std::string unit;  ///< unit in flexneck's notation; empty if the file names none
  double first_s = 0;
  double interval_s = 0;   ///< positive
  Eigen::VectorXd values;  ///< shape (n), n > 1, in that unit, finite

  Eigen::VectorXd time_s() const;
};

/// Reads a channel's file, <test>.001.
/// @throws InputError with file and line for another kind of file, an invalid code, a unit that
/// does not fit the code's physical dimension, times in another channel ("explicit"), an interval
/// that is not positive, a number of samples that differs from the header's, and a sample that is
/// not a finite number, NOVALUE among them.
MmeChannel read_mme_channel_file(const std::filesystem::path& path);

}  // namespace flexneck::pipeline
