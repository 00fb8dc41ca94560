// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "pipeline/document/key.h"

namespace flexneck::pipeline {

/// Figures of the neck to compare with, published ones as a rule, SI units.
struct Reference {
  std::string origins = "published";  ///< what the file says of them
  double tolerance_percent = 0;
  std::vector<double> bending_Hz, torsion_Hz;  ///< ascending
  std::vector<std::string> mode_order;         ///< kinds in the order of frequency
  double weight_kg = 0;
  double system_frequency_Hz = 0;
  double frequency_ratio = 0;  ///< first bending frequency over the system's
  double effective_damping = 0;
};

/// The table of keys of such a file.
std::span<const Key> reference_keys();

/// @throws InputError if the file does not say what it must.
Reference read_reference(const std::filesystem::path& path);

}  // namespace flexneck::pipeline
