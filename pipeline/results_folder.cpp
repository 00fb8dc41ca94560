// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/results_folder.h"

#include <algorithm>
#include <array>

#include "geometry/foundation/error.h"
#include "pipeline/version.h"

namespace flexneck::pipeline {

namespace fs = std::filesystem;

namespace {

/// What experiments know by the modes only.
constexpr std::array<const char*, 5> kOfTheModes = {"geometry.", "mesh.", "modes.",
                                                    "substructures.", "interface."};

}  // namespace

void ResultsFolder::make() const {
  std::error_code error;
  fs::create_directories(path_, error);
  if (error || !fs::is_directory(path_)) {
    throw InputError(path_.string() + ": cannot be made a folder for results (" +
                     (error ? error.message() : "it is a file") + "); choose another with -o");
  }
}

fs::path ResultsFolder::history(const CaseSection& experiment) const {
  const bool pendulum = experiment.kind == CaseSection::Kind::pendulum;
  return path_ / ((pendulum ? "pendulum-" : "static-") + experiment.name + ".h5");
}

Provenance provenance_of(const std::vector<InputFile>& files,
                         const std::vector<Parameter>& parameters) {
  Provenance provenance;
  provenance.program = std::string("flexneck ") + kVersion;
  provenance.git_hash = kGitHash;
  provenance.inputs = files;
  provenance.parameters = parameters;
  return provenance;
}

Provenance provenance_of(const Study& study, const std::vector<std::string>& prefixes) {
  Provenance provenance = provenance_of(study.files, {});
  if (prefixes.empty())
    provenance.inputs.insert(provenance.inputs.end(), study.tables.begin(), study.tables.end());
  const auto wanted = [&](const Parameter& parameter) {
    return prefixes.empty() ||
           std::any_of(prefixes.begin(), prefixes.end(), [&](const std::string& prefix) {
             return parameter.key.starts_with(prefix);
           });
  };
  std::copy_if(study.parameters.begin(), study.parameters.end(),
               std::back_inserter(provenance.parameters), wanted);
  return provenance;
}

Provenance mesh_provenance(const Study& study) {
  Provenance provenance = provenance_of(study, {"geometry.", "mesh."});
  std::erase_if(provenance.parameters, [](const Parameter& parameter) {
    return parameter.key.starts_with("geometry.materials.") &&
           (parameter.key.ends_with(".formulation") ||
            parameter.key.ends_with(".static_modulus_ratio"));
  });
  const fs::path& source = study.structure ? study.structure->file() : study.geometry->script;
  provenance.inputs.push_back({source.filename().string(), hash_of_file(source.string())});
  return provenance;
}

Provenance modes_provenance(const Study& study) {
  return provenance_of(study, {"geometry.", "mesh.", "modes.", "substructures.", "interface.",
                               "body." + study.modes.attached_body + "."});
}

Provenance experiment_provenance(const Study& study, CaseSection::Kind kind) {
  std::vector<std::string> others(kOfTheModes.begin(), kOfTheModes.end());
  if (kind == CaseSection::Kind::pendulum) {
    others.insert(others.end(), {"static.", "force."});
  } else {
    others.insert(others.end(), {"pendulum.", "pulse.", "head_spring.", "rigid_neck."});
  }
  for (const CaseSection& experiment : study.cases)
    if (experiment.kind != kind) others.push_back("case." + experiment.name + ".");
  Provenance provenance = provenance_of(study);
  std::erase_if(provenance.parameters, [&](const Parameter& parameter) {
    return std::any_of(others.begin(), others.end(), [&](const std::string& prefix) {
      return parameter.key.starts_with(prefix);
    });
  });
  return provenance;
}

void require_same_inputs(const fs::path& file, const Provenance& made_from, const Study& study,
                         const std::string& made_by) {
  for (const Parameter& then : made_from.parameters) {
    const auto now =
        std::find_if(study.parameters.begin(), study.parameters.end(),
                     [&](const Parameter& parameter) { return parameter.key == then.key; });
    if (now == study.parameters.end() || now->value == then.value) continue;
    throw InputError(file.string() + ": was made with " + then.key + " = " + then.value +
                     ", the study has " + now->value + "; make it again with '" + made_by + "'");
  }
}

}  // namespace flexneck::pipeline
