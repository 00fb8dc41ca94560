// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "geometry/foundation/provenance.h"
#include "multibody/analysis/linearisation.h"
#include "multibody/model/model.h"
#include "multibody/simulation/simulation.h"
#include "pipeline/document/document_source.h"
#include "pipeline/document/key.h"
#include "pipeline/model/channel.h"
#include "pipeline/model/relaxation.h"

namespace flexneck::pipeline {

/// [output] and [[channel]]
struct OutputSection {
  double interval_s = 1e-3;
  std::vector<std::string> markers;  ///< whose histories are written
  std::vector<std::string> joints;   ///< likewise
  bool states = false;               ///< of all bodies, too, for a restart
  std::vector<ChannelSpec> channels;
};

/// Everything that a model file says, in SI units.
struct ModelFile {
  /// State at time zero.
  enum class Start {
    given,       ///< as the bodies are given
    equilibrium  ///< at rest against the prescribed bodies, moving with them
  };

  enum class Analysis {
    motion,
    quasi_static  ///< static equilibria at the output times
  };

  std::filesystem::path file;
  multibody::Model model;
  multibody::SolverOptions solver;
  Analysis analysis = Analysis::motion;
  Start start = Start::given;
  std::optional<multibody::LinearisedAt> linearised_at;
  std::map<std::size_t, Relaxation> relaxations;  ///< of sections that relax
  std::vector<double> rates_rad_s;                ///< of a Campbell diagram; empty for none
  double end_time_s = 1;
  bool has_expressions = false;  ///< motions or loads by them, seen at solver.resolution_s
  OutputSection output;

  std::vector<InputFile> files;  ///< everything that was read
  std::vector<Parameter> parameters;
  std::vector<std::string>
      warnings;  ///< of names of earlier versions, masses that a restart finds changed
};

/// The table of keys of model files, by section.
std::span<const Key> model_keys();

/// Reads a model file (pipeline/models/README.md) and what it names: modes and tables.
/// @param settings  "dotted.key=value", as read_study()
/// @throws InputError with file, line, column and key for everything that is not right.
ModelFile read_model_file(const DocumentSource& source, const std::vector<std::string>& settings);

}  // namespace flexneck::pipeline
