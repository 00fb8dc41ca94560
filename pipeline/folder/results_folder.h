// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "geometry/foundation/hdf5_file.h"
#include "geometry/foundation/provenance.h"
#include "pipeline/study/study.h"

namespace flexneck::pipeline {

/// Where a study's files are.
class ResultsFolder {
 public:
  explicit ResultsFolder(std::filesystem::path path) : path_(std::move(path)) {}

  /// @throws InputError if the folder cannot be made.
  void make() const;
  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path mesh() const { return path_ / "mesh.h5"; }
  std::filesystem::path modes() const { return path_ / "modes.h5"; }
  /// Modes with the static moduli, where a material has one.
  std::filesystem::path static_modes() const { return path_ / "modes_static.h5"; }
  /// Displacements and stresses of the static step under the study's loads.
  std::filesystem::path stress() const { return path_ / "stress.h5"; }
  /// Modes of one piece of the structure.
  std::filesystem::path substructure(const std::string& piece) const {
    return path_ / ("substructure_" + piece + ".h5");
  }
  /// Derivatives of the modes, where they were asked for.
  std::filesystem::path sensitivities() const { return path_ / "sensitivities.json"; }
  std::filesystem::path mesh_picture() const { return path_ / "mesh.png"; }
  std::filesystem::path modes_picture() const { return path_ / "modes.png"; }
  std::filesystem::path history(const CaseSection& experiment) const;
  /// The channels of that file as text, in the paper's units.
  std::filesystem::path curves(const CaseSection& experiment) const {
    return history(experiment).replace_extension(".csv");
  }
  std::filesystem::path verification() const { return path_ / "verification.json"; }
  std::filesystem::path file(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

/// What a result was made from: the program, the files read and all values.
Provenance provenance_of(const std::vector<InputFile>& files,
                         const std::vector<Parameter>& parameters);

/// What a result of this study was made from: the program, the study's files, and those of its
/// values whose key begins with one of the prefixes, such as "geometry." (all if there is none).
Provenance provenance_of(const Study& study, const std::vector<std::string>& prefixes = {});

/// What the study says of [geometry] and [mesh], save what only the solver asks of its materials.
std::vector<Parameter> mesh_values(const Study& study);
/// What the study says of the mesh and the modes.
/// @param with_attached  of the attached body, too, for the frequencies with it
std::vector<Parameter> modes_values(const Study& study, bool with_attached = true);
/// The values and files of a study that a mesh is made from.
Provenance mesh_provenance(const Study& study);
/// The same for the modes of a mesh.
Provenance modes_provenance(const Study& study);
/// The same for verdicts on all experiments, and for what shows them.
Provenance verdict_provenance(const Study& study);
/// The same for the experiments of a kind with the modes, all cases.
Provenance experiment_provenance(const Study& study, CaseSection::Kind kind);
/// The same for one case: of sections with a name, only what it uses.
Provenance case_provenance(const Study& study, const CaseSection& experiment);

/// Refuses a file that was made with other values than the study has now, given or by default, or
/// from files that are others by now: what a mesh or modes of matrices are made from, tables. One
/// that another program has made is taken as it is.
/// @param expected the values that it would be made from now; empty if they are not known
/// @throws InputError naming the first value or file that differs, and the command that makes the
/// file.
void require_same_inputs(const std::filesystem::path& file, const Provenance& made_from,
                         const Study& study, const std::vector<Parameter>& expected,
                         const std::string& made_by);

/// The name of a file of its folder that a result was made from, if another one is there now; else
/// empty.
std::string replaced_source(const std::filesystem::path& file, const Provenance& made_from);

/// A warning if a file is about to be replaced by one that is made from other values; else empty.
std::string replaced_values(const std::filesystem::path& file, const FileFormat& format,
                            const Provenance& now);

}  // namespace flexneck::pipeline
