// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "pipeline/language/document/key.h"

namespace flexneck::pipeline {

/// Reference figures of the neck, usually published ones, in SI units.
struct Reference {
  std::string origins = "published";  ///< origin of the figures as the file states it
  double tolerance_percent = 0;
  std::vector<double> bending_Hz, torsion_Hz;  ///< ascending
  std::vector<std::string> mode_order;         ///< kinds in the order of frequency
  double weight_kg = 0;
  double system_frequency_Hz = 0;
  double frequency_ratio = 0;  ///< first bending frequency over the system's
  double effective_damping = 0;
};

/// Table of keys of a file with reference figures.
std::span<const Key> reference_keys();

/// Reads reference figures. @throws InputError if the file lacks required data.
Reference read_reference(const std::filesystem::path& path);

}  // namespace flexneck::pipeline
