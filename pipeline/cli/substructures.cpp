// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/cli/substructures.h"

#include <fmt/format.h>

#include "fe_modal/analysis/modal_analysis.h"
#include "fe_modal/body/modal_body_file.h"
#include "geometry/foundation/names.h"
#include "pipeline/parameter_studies/evaluation/pieces_of_cases.h"
#include "pipeline/parameter_studies/evaluation/substructures.h"
#include "pipeline/process/result_files.h"
#include "pipeline/process/text_table.h"

namespace flexneck::pipeline {

void write_substructures(const CommandInput& input, const mesher::Mesh& mesh,
                         const fe_modal::ModalOptions& whole, const Provenance& provenance) {
  if (input.study.substructures.pieces.empty()) return;
  std::vector<std::vector<std::string>> rows = {
      {"substructure", "fixed", "interfaces", "modes", "kg", "Hz", "file"}};
  for (const Substructure& piece : substructures_of(input.study, mesh, whole)) {
    input.console.step("Reducing substructure " + piece.name);
    const std::filesystem::path path = input.folder.substructure(piece.name);
    fe_modal::ModalBodyFile file;
    file.body = fe_modal::analyse_modes(piece.mesh, piece.options, input.console.detail(), nullptr,
                                        input.console.warnings(path.filename().string()));
    require_rigid_face(input.study, piece, file.body);
    file.provenance = provenance;
    if (writes(input)) fe_modal::write_modal_body(path, file);
    const Eigen::VectorXd& frequencies = file.body.frequencies_Hz;
    rows.push_back({piece.name, piece.options.fixed_set,
                    fmt::format("{}", fmt::join(names_of(piece.options.interfaces), ", ")),
                    std::to_string(frequencies.size()),
                    fmt::format("{:.4f}", file.body.invariants.mass),
                    fmt::format("{:.1f} to {:.1f}", frequencies.minCoeff(), frequencies.maxCoeff()),
                    path.filename().string()});
  }
  input.console.result("\n" + text_table(rows, {0, 1, 2, 6}));
}

Pieces read_pieces(const CommandInput& input, std::vector<InputFile>& files) {
  Pieces pieces;
  for (const PieceSection& piece : input.study.substructures.pieces) {
    const std::filesystem::path path = input.folder.substructure(piece.name);
    fe_modal::ModalBodyFile file = read_modal_body(path);
    require_same_inputs(path, file.provenance, input.study,
                        modes_provenance(input.study).parameters, "flexneck modes");
    files.push_back({path.filename().string(), hash_of_file(path.string())});
    pieces.emplace(piece.name, std::move(file.body));
  }
  return pieces;
}

Study with_pieces(const CommandInput& input, std::vector<InputFile>& files) {
  if (!has_cases_of_pieces(input.study)) return input.study;
  return with_pieces(input.study, read_pieces(input, files));
}

}  // namespace flexneck::pipeline
