// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/run/results_folder.h"

#include <algorithm>

#include "geometry/foundation/error.h"
#include "mesher/exchange/script_files.h"
#include "pipeline/language/model/model_sections.h"
#include "pipeline/process/result_files.h"
#include "pipeline/version.h"

namespace flexneck::pipeline {

namespace fs = std::filesystem;

namespace {

UsedBy used_by(const Parameter& parameter) {
  return find_dotted_key(study_keys(), parameter.key).used_by;
}

/// Prefixes of the keys that a case refers to. A variant also has the values of its base case.
std::vector<std::string> named_by(const CaseSection& experiment) {
  const std::string& own = experiment.variant_of.empty() ? experiment.name : experiment.variant_of;
  std::vector<std::string> prefixes = {
      experiment.kind == CaseSection::Kind::pendulum ? "pendulum." : "static.",
      "case." + own + "."};
  const auto add = [&](const std::string& section, const std::string& name) {
    if (!name.empty()) prefixes.push_back(section + "." + name + ".");
  };
  add("variant", experiment.made_by);
  add("pulse", experiment.pulse);
  for (const std::string& force : experiment.forces)
    for (const ModelSection& section : force_sections()) add(std::string(section.key.name), force);
  return prefixes;
}

/// True if a key changes results; keys of other programs may not be in the table and count.
bool matters(const std::string& key) {
  const Key* const row = find_dotted_key(study_keys(), key).key;
  return row == nullptr || row->details.changes_results;
}

const Parameter* find(const std::vector<Parameter>& parameters, const std::string& key) {
  const auto found = std::find_if(parameters.begin(), parameters.end(),
                                  [&](const Parameter& parameter) { return parameter.key == key; });
  return found == parameters.end() ? nullptr : &*found;
}

/// Provenance of a file; empty if there is none, since then no later stage could have used it.
Provenance provenance_in(const fs::path& file, const FileFormat& format) {
  if (!fs::exists(file)) return {};
  try {
    const ReadableFile readable(file, format.name);
    return read_provenance(Hdf5Reader(readable.path(), format));
  } catch (const InputError&) {
    return {};
  }
}

template <typename Prefixes>
bool begins_with_one_of(const std::string& key, const Prefixes& prefixes) {
  return std::any_of(prefixes.begin(), prefixes.end(),
                     [&](const auto& prefix) { return key.starts_with(prefix); });
}

Provenance provenance_using(const Study& study, const std::vector<std::string>& named) {
  Provenance provenance = provenance_of(study);
  std::erase_if(provenance.parameters, [&](const Parameter& parameter) {
    return used_by(parameter) != UsedBy::all_experiments &&
           !begins_with_one_of(parameter.key, named);
  });
  return provenance;
}

}  // namespace

void ResultsFolder::make() const {
  std::error_code error;
  fs::create_directories(path_, error);
  if (error || !fs::is_directory(path_)) {
    throw InputError(path_.string() + ": the folder for results cannot be created (" +
                     (error ? error.message() : "a file has this name") +
                     "); choose another with -o");
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
    return prefixes.empty() || begins_with_one_of(parameter.key, prefixes);
  };
  std::copy_if(study.parameters.begin(), study.parameters.end(),
               std::back_inserter(provenance.parameters), wanted);
  return provenance;
}

std::vector<Parameter> mesh_values(const Study& study) {
  std::vector<Parameter> values = study.parameters;
  std::erase_if(values, [](const Parameter& each) { return used_by(each) != UsedBy::mesh; });
  return values;
}

Provenance mesh_provenance(const Study& study) {
  return provenance_of(study.files, mesh_values(study));
}

std::vector<Parameter> modes_values(const Study& study, bool with_attached) {
  std::vector<Parameter> values = study.parameters;
  const std::string attached = "body." + study.modes.attached_body + ".";
  std::erase_if(values, [&](const Parameter& each) {
    const UsedBy user = used_by(each);
    return user != UsedBy::mesh && user != UsedBy::modes &&
           !(with_attached && each.key.starts_with(attached));
  });
  return values;
}

Provenance modes_provenance(const Study& study) {
  return provenance_of(study.files, modes_values(study));
}

Provenance verdict_provenance(const Study& study) {
  Provenance provenance = provenance_of(study);
  provenance.inputs.insert(provenance.inputs.end(), study.rules.begin(), study.rules.end());
  return provenance;
}

Provenance experiment_provenance(const Study& study, CaseSection::Kind kind) {
  std::vector<std::string> used;
  for (const CaseSection& experiment : study.cases) {
    if (experiment.kind != kind) continue;
    const std::vector<std::string> more = named_by(experiment);
    used.insert(used.end(), more.begin(), more.end());
  }
  return provenance_using(study, used);
}

Provenance case_provenance(const Study& study, const CaseSection& experiment) {
  return provenance_using(study, named_by(experiment));
}

std::string replaced_source(const fs::path& file, const Provenance& made_from) {
  if (made_from.program.empty()) return {};
  for (const InputFile& input : made_from.inputs) {
    const fs::path source = file.parent_path() / input.name;
    if (source.extension() == ".h5" && fs::exists(source) &&
        hash_of_file(source.string()) != input.hash)
      return input.name;
  }
  return {};
}

namespace {

bool names(const Provenance& made_from, const std::string& name) {
  return std::any_of(made_from.inputs.begin(), made_from.inputs.end(),
                     [&](const InputFile& input) { return input.name == name; });
}

/// Current state of the source files of a mesh or of modes of matrices; none if the result was not
/// made from the study's, or if a script may read unknown files.
std::vector<InputFile> sources_now(const Provenance& made_from, const Study& study) {
  FilesRead reads;
  if (study.matrices && names(made_from, study.matrices->stiffness.filename().string())) {
    for (const fs::path& path :
         {study.matrices->stiffness, study.matrices->mass, study.matrices->nodes})
      note_read(path);
  } else if (study.structure && names(made_from, study.structure->file().filename().string())) {
    const auto* const script = std::get_if<mesher::ScriptMeshOptions>(&study.structure->source);
    script != nullptr ? mesher::note_script_files(script->script)
                      : note_read(study.structure->file());
  }
  const std::vector<FileRead> found = reads.files();
  reads.forget();  // this check does not count as reading
  return std::any_of(found.begin(), found.end(), is_unknown) ? std::vector<InputFile>()
                                                             : input_files(found);
}

}  // namespace

void require_same_inputs(const fs::path& file, const Provenance& made_from, const Study& study,
                         const std::vector<Parameter>& expected, const std::string& made_by) {
  if (made_from.program.empty() || study.parameters.empty()) return;
  const auto refuse = [&](const std::string& difference) {
    throw InputError(file.string() + ": was made " + difference + "; make it again with '" +
                     made_by + "'");
  };
  const std::vector<Parameter>& made_with = made_from.parameters;
  for (const Parameter& then : made_with) {
    if (!matters(then.key)) continue;
    const std::string with = "with " + then.key + " = " + then.value + ", but the study has ";
    const Parameter* now = find(study.parameters, then.key);
    if (now == nullptr) now = find(study.defaults, then.key);
    if (now == nullptr) refuse(with + "none");
    if (now->value != then.value) refuse(with + now->value);
  }
  for (const Parameter& now : expected) {
    if (find(made_with, now.key) == nullptr && matters(now.key))
      refuse("without " + now.key + ", but the study has " + now.value);
  }
  std::vector<InputFile> files = sources_now(made_from, study);
  files.insert(files.end(), study.tables.begin(), study.tables.end());
  for (const InputFile& now : files) {
    const auto& inputs = made_from.inputs;
    if (names(made_from, now.name) && std::find(inputs.begin(), inputs.end(), now) == inputs.end())
      refuse("from a different " + now.name + " than the current one");
  }
}

namespace {

/// True if the folder of a file holds more than a mesh, i.e. results that must agree with it.
bool has_more_than_mesh(const fs::path& file) {
  std::error_code ignored;
  const fs::directory_iterator entries(file.parent_path().empty() ? "." : file.parent_path(),
                                       ignored);
  return std::any_of(begin(entries), end(entries), [](const fs::directory_entry& entry) {
    const std::string stem = entry.path().stem().string();
    return entry.path().extension() == ".h5" && stem != "mesh" && stem != "mesh_view";
  });
}

}  // namespace

std::string replaced_values(const fs::path& file, const FileFormat& format, const Provenance& now) {
  if (!has_more_than_mesh(file)) return {};
  const Provenance made_from = provenance_in(file, format);
  if (made_from.program.empty()) return {};
  const std::vector<Parameter>& then = made_from.parameters;
  const auto text = [](const Parameter* parameter) {
    return parameter == nullptr ? "none" : parameter->value;
  };
  const auto difference = [&](const std::string& key) -> std::string {
    const Parameter* const before = find(then, key);
    const Parameter* const after = find(now.parameters, key);
    if (!matters(key) || text(before) == text(after)) return {};
    return file.string() + ": was made with " + key + " = " + text(before) + ", now with " +
           text(after) +
           "; other results in the folder were made with the former value; 'flexneck run' makes " +
           "all of them consistent";
  };
  for (const auto* const parameters : {&then, &now.parameters}) {
    for (const Parameter& parameter : *parameters) {
      if (std::string found = difference(parameter.key); !found.empty()) return found;
    }
  }
  return {};
}

}  // namespace flexneck::pipeline
