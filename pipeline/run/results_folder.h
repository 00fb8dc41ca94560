// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "geometry/foundation/hdf5_file.h"
#include "geometry/foundation/provenance.h"
#include "pipeline/language/study/study.h"

namespace flexneck::pipeline {

/// Paths of a study's files of results.
class ResultsFolder {
 public:
  explicit ResultsFolder(std::filesystem::path path) : path_(std::move(path)) {}

  /// Creates the folder. @throws InputError if that fails.
  void make() const;
  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path mesh() const { return path_ / "mesh.h5"; }
  std::filesystem::path modes() const { return path_ / "modes.h5"; }
  /// Modes with the static moduli, if a material has one.
  std::filesystem::path static_modes() const { return path_ / "modes_static.h5"; }
  /// Displacements and stresses of the static step under the study's loads.
  std::filesystem::path stress() const { return path_ / "stress.h5"; }
  /// Modes of one submesh of the structure.
  std::filesystem::path substructure(const std::string& piece) const {
    return path_ / ("substructure_" + piece + ".h5");
  }
  /// Derivatives of the modes, if they were asked for.
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

/// Provenance of a result: the program, the files read and all values.
Provenance provenance_of(const std::vector<InputFile>& files,
                         const std::vector<Parameter>& parameters);

/// Provenance of a result of this study: the program, the study's files, and those of its values
/// whose key begins with one of the prefixes, such as "geometry." (all if there is none).
Provenance provenance_of(const Study& study, const std::vector<std::string>& prefixes = {});

/// Values of [geometry] and [mesh], except those of the materials that only the solver uses.
std::vector<Parameter> mesh_values(const Study& study);
/// Values of the mesh and the modes.
/// @param with_attached  includes the attached body, for the frequencies with it
std::vector<Parameter> modes_values(const Study& study, bool with_attached = true);
/// Values and files of a study that its mesh depends on.
Provenance mesh_provenance(const Study& study);
/// Values and files that the modes of a mesh depend on.
Provenance modes_provenance(const Study& study);
/// Values and files that verdicts on all experiments depend on, and their display.
Provenance verdict_provenance(const Study& study);
/// Values and files that all experiments of a kind depend on, modes included.
Provenance experiment_provenance(const Study& study, CaseSection::Kind kind);
/// Values and files that one case depends on: of named sections, only those it uses.
Provenance case_provenance(const Study& study, const CaseSection& experiment);

/// Refuses a file that was made with other values than the study has now, given or by default, or
/// from files that have changed since: sources of a mesh or of modes of matrices, and tables. A
/// file made by another program is accepted.
/// @param expected the values that it would be made from now; empty if unknown
/// @throws InputError naming the first value or file that differs, and the command that makes the
/// file.
void require_same_inputs(const std::filesystem::path& file, const Provenance& made_from,
                         const Study& study, const std::vector<Parameter>& expected,
                         const std::string& made_by);

/// Name of a file in the same folder that a result was made from and that has been replaced since;
/// else empty.
std::string replaced_source(const std::filesystem::path& file, const Provenance& made_from);

/// Warning if a file is about to be replaced by one made from other values; else empty.
std::string replaced_values(const std::filesystem::path& file, const FileFormat& format,
                            const Provenance& now);

}  // namespace flexneck::pipeline
