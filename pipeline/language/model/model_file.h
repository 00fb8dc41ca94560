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
#include "pipeline/language/document/document_source.h"
#include "pipeline/language/document/key.h"
#include "pipeline/language/model/channel.h"
#include "pipeline/language/model/relaxation.h"

namespace flexneck::pipeline {

/// Content of [output] and [[channel]].
struct OutputSection {
  double interval_s = 1e-3;
  std::vector<std::string> markers;  ///< whose histories are written
  std::vector<std::string> joints;   ///< names of the joints whose histories are written
  bool states = false;  ///< whether the states of all bodies are written, too, for a restart
  std::vector<ChannelSpec> channels;
};

/// Content of a model file, in SI units.
struct ModelFile {
  /// State at time zero.
  enum class Start {
    given,       ///< the given poses and velocities of the bodies
    equilibrium  ///< relative equilibrium with the prescribed bodies, moving with them
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
  std::map<std::size_t, Relaxation> relaxations;  ///< for the sections that relax
  std::vector<double> rates_rad_s;                ///< speeds of a Campbell diagram; empty for none
  double end_time_s = 1;
  /// True if expressions, sampled at solver.resolution_s, give motions or loads.
  bool has_expressions = false;
  OutputSection output;

  std::vector<InputFile> files;  ///< all files that were read
  std::vector<Parameter> parameters;
  std::vector<std::string> warnings;  ///< warnings about masses that differ from a restart's
};

/// The table of keys of model files, by section.
std::span<const Key> model_keys();

/// Reads a model file (manual/reference/model_files.md) and the files that it names: modes and
/// tables.
/// @param settings  "dotted.key=value", as for read_study()
/// @throws InputError with file, line, column and key for any error in the file.
ModelFile read_model_file(const DocumentSource& source, const std::vector<std::string>& settings);

}  // namespace flexneck::pipeline
