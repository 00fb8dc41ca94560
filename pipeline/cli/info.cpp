// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "geometry/foundation/error.h"
#include "geometry/foundation/hdf5_file.h"
#include "mesher/mesh/bounding_box.h"
#include "pipeline/cli/basis_text.h"
#include "pipeline/cli/commands.h"
#include "pipeline/cli/mesh_result.h"
#include "pipeline/cli/mode_table.h"
#include "pipeline/cli/stress_text.h"
#include "pipeline/experiments/verification/verification.h"
#include "pipeline/parameter_studies/sweep/sweep_table.h"
#include "pipeline/process/result_files.h"
#include "pipeline/process/result_table.h"
#include "pipeline/process/text_table.h"
#include "pipeline/results/report/results.h"
#include "pipeline/results/tables/summary.h"
#include "pipeline/run/remembered_study.h"

namespace flexneck::pipeline {

namespace {

namespace fs = std::filesystem;

/// File extension that tells the format, and a description of such a file.
struct Ending {
  std::string_view ending, what;
};
constexpr std::array<Ending, 7> kEndings = {{{".csv", "curves or table"},
                                             {".html", "HTML page"},
                                             {".json", "tables"},
                                             {".png", "picture"},
                                             {".svg", "picture"},
                                             {".xdmf", "view for ParaView"},
                                             {".toml", "study or model"}}};

/// Description of a file; empty for a file of another program.
std::string what_is(const fs::path& path) {
  if (path.extension() == ".h5") {
    try {
      return format_of(ReadableFile(path).path());
    } catch (const InputError&) {
      return "damaged, or made by another program";
    }
  }
  for (const Ending& each : kEndings)
    if (path.extension() == each.ending) return std::string(each.what);
  return {};
}

/// Files that share one row: "pendulum-*.h5" for the files of many cases.
struct Group {
  std::vector<fs::path> files;
  std::uintmax_t bytes = 0;
};

std::map<std::string, Group> groups_in(const fs::path& folder) {
  std::map<std::string, Group> groups;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const fs::path& path = entry.path();
    if (!entry.is_regular_file() || path.filename().string().starts_with('.')) continue;
    const std::string stem = path.stem().string();
    const std::size_t dash = stem.find('-');
    const std::string name = dash == std::string::npos
                                 ? path.filename().string()
                                 : stem.substr(0, dash) + "-*" + path.extension().string();
    Group& group = groups[name];
    group.files.push_back(path);
    group.bytes += entry.file_size();
  }
  return groups;
}

std::string verdict_of(const fs::path& file) {
  if (!fs::is_regular_file(file)) return {};
  const VerificationTable table = read_verification(file).table;
  const auto count = [&](VerificationRow::Status status) {
    return std::count_if(table.rows.begin(), table.rows.end(),
                         [&](const VerificationRow& row) { return row.status == status; });
  };
  const auto passed = count(VerificationRow::Status::passed);
  const auto judged = passed + count(VerificationRow::Status::failed);
  return judged == 0 ? "\nVerification: no figure has a verdict"
                     : fmt::format("\nVerification against {} figures: {} of {} agree",
                                   table.reference_origins, passed, judged);
}

/// Describes a folder of results: the study that it remembers, its verdict if it was verified, and
/// a line for each file, or for each kind where there are many, as of runs.
/// @throws InputError if the folder holds nothing of flexneck.
std::string folder_text(const fs::path& folder) {
  std::vector<std::vector<std::string>> rows = {{"file", "what it is", "number", "KiB"}};
  bool is_ours = false;
  for (const auto& [name, group] : groups_in(folder)) {
    const std::string what = what_is(group.files.front());
    is_ours = is_ours || what.starts_with("flexneck ");
    const bool is_one = group.files.size() == 1;
    rows.push_back({is_one ? group.files.front().filename().string() : name, what,
                    std::to_string(group.files.size()),
                    std::to_string((group.bytes + 1023) / 1024)});
  }
  const std::optional<StudyChoice> choice = remembered_study(folder);
  if (!is_ours && !choice)
    throw InputError(folder.string() +
                     ": expected a folder of results, found no result files of flexneck; create "
                     "them with 'flexneck run -o " +
                     folder.string() + "'");
  std::sort(rows.begin() + 1, rows.end(),
            [](const auto& a, const auto& b) { return comes_before(a.front(), b.front()); });
  return folder.string() + ": " +
         (choice ? "results of the study " + text_of(*choice) : "results of models") +
         verdict_of(folder / "verification.json") + "\n" + text_table(rows, {0, 1}) +
         "\n'flexneck info " + (folder / "FILE").string() + "' describes one of them";
}

}  // namespace

namespace fs = std::filesystem;

namespace {

/// Text of a file's provenance: program, files, libraries and values.
std::string provenance_text(const Provenance& provenance) {
  if (provenance.program.empty()) return "\nMade by an unknown program";
  std::string text =
      fmt::format("\nMade by {}, commit {}, from", provenance.program, provenance.git_hash);
  for (const InputFile& input : provenance.inputs) text += "\n  " + input.name + "  " + input.hash;
  for (const auto& [name, version] : provenance.libraries) text += "\n  " + name + " " + version;
  if (provenance.parameters.empty()) return text;
  std::vector<std::vector<std::string>> rows = {{"input", "value", "origin"}};
  for (const Parameter& parameter : provenance.parameters)
    rows.push_back({parameter.key, parameter.value, std::string(name_of(parameter.origin))});
  return text + "\n" + text_table(rows, {0, 1, 2});
}

std::string describe_mesh(const fs::path& path) {
  const mesher::MeshFile file = mesher::read_mesh(path);
  std::string text = mesh_text(file.mesh, {}, true);
  for (const mesher::NodeSet& set : file.mesh.node_sets)
    text += fmt::format("\nNode set {}: {} nodes", set.name, set.nodes.size());
  for (const mesher::FaceSet& set : file.mesh.face_sets) {
    std::size_t faces = 0;
    for (const mesher::FaceBlock& block : set.blocks) faces += block.size();
    text += fmt::format("\nFace set {}: {} faces", set.name, faces);
  }
  for (const mesher::Slit& slit : file.mesh.slits)
    text += fmt::format("\nSlit {}: {} pairs of nodes, {}", slit.name, slit.lower.size(),
                        slit.tied ? "closed" : "open");
  return text + provenance_text(file.provenance);
}

std::string describe_modes(const fs::path& path) {
  const fe_modal::ModalBodyFile file = fe_modal::read_modal_body(path);
  std::string text = fmt::format(
      "{}, {}; mass {:.4g} kg, {} nodes\nSolver: {}\n{}{}", file.body.boundary,
      file.body.completeness, file.body.invariants.mass, file.body.nodes_m.cols(), file.body.solver,
      mode_table(file.body, true), "\n" + basis_text(file.body) + loaded_text(file.body, true));
  if (!file.body.prestress.empty()) text += "\nPrestress: " + file.body.prestress;
  for (const fe_modal::Interface& interface : file.body.interfaces) {
    const Eigen::Vector3d& at = interface.position_m;
    text += fmt::format("\nInterface {} at ({:.4g}, {:.4g}, {:.4g}) m", interface.name, at[0],
                        at[1], at[2]);
  }
  return text + provenance_text(file.provenance);
}

std::string describe_stresses(const fs::path& path) {
  const fe_modal::StaticSolutionFile file = fe_modal::read_static_solution(path);
  return fmt::format("{}; {} nodes\nSolver: {}\n{}", file.solution.boundary,
                     file.solution.nodes_m.cols(), file.solution.solver,
                     stress_text(file.solution)) +
         provenance_text(file.provenance);
}

std::string describe_history(const fs::path& path) {
  const multibody::HistoryFile file = multibody::read_history(path);
  const Eigen::VectorXd& times_s = file.history.time_s;
  std::string text = run_summary(file.history);
  if (times_s.size() > 0)
    text += fmt::format("\n{} output times from {:.4g} to {:.4g} s", times_s.size(), times_s[0],
                        times_s[times_s.size() - 1]);
  if (file.linearisation) text += "\n" + mode_summary(*file.linearisation);
  if (!file.channels.empty()) {
    PeakTable peaks;
    peaks.append(times_s, file.channels);
    text += "\n" + peaks.text();
  }
  return text + provenance_text(file.provenance);
}

/// Text with the rows and columns of a sweep's table.
std::string describe_sweep(const fs::path& path) {
  const Hdf5Reader file(path, kSweepFormat);
  std::string text;
  for (const std::string group : {"/inputs", "/outputs"}) {
    for (const std::string& name : file.members(group)) {
      const std::string column = group + "/" + name;
      const std::string unit = file.string_attribute(column, "units");
      text += fmt::format("{}{} {}{}: {} rows", text.empty() ? "" : "\n", group.substr(1), name,
                          unit == "1" ? "" : " [" + unit + "]", file.shape(column).at(0));
    }
  }
  const std::size_t failed = file.has("/failed/rows") ? file.shape("/failed/rows").at(0) : 0;
  return text + fmt::format("\n{} rows lack outputs", failed) +
         provenance_text(read_provenance(file));
}

std::string describe_tables(const fs::path& path) {
  const TableFile file = read_tables(path);
  std::string text;
  for (const ResultTable& table : file.tables)
    text += (text.empty() ? "" : "\n\n") + printed(table);
  return text + "\n" + provenance_text(file.provenance);
}

std::string describe_verification(const fs::path& path) {
  const VerificationFile file = read_verification(path);
  return printed(file.table) + "\n" + provenance_text(file.provenance);
}

/// Text with the format of an HDF5 file, and whether its bytes are unchanged since flexneck wrote
/// it.
std::string described_format(const fs::path& path, const std::string& format) {
  if (format.empty()) return {};
  return format + (trust_of(path) == Trust::verified ? ", verified: unchanged since it was written"
                                                     : ", not verified: it contains no hash");
}

struct Kind {
  std::string_view format;
  std::string (*describe)(const fs::path&);
};

constexpr std::array<Kind, 5> kKinds = {{{kSweepFormat.name, describe_sweep},
                                         {mesher::kMeshFormat.name, describe_mesh},
                                         {fe_modal::kModalBodyFormat.name, describe_modes},
                                         {fe_modal::kStaticSolutionFormat.name, describe_stresses},
                                         {multibody::kHistoryFormat.name, describe_history}}};

}  // namespace

bool info_command(const FileInput& input) {
  if (input.files.empty())
    throw InputError("info: expected a file or a folder of results, as in 'flexneck info out'");
  for (const fs::path& path : input.files) {
    if (fs::is_directory(path)) {
      input.console.result(folder_text(path));
      continue;
    }
    if (!fs::is_regular_file(path)) throw InputError(path.string() + ": no such file");
    const bool is_json = path.extension() == ".json";
    std::string format;
    std::string text;
    if (!is_json) {
      const ReadableFile file(path);
      format = format_of(file.path());
      for (const Kind& kind : kKinds) {
        if (format == kind.format) text = kind.describe(file.path());
      }
    }
    if (text.empty() && is_json && holds_tables(path)) text = describe_tables(path);
    if (text.empty() && is_json) text = describe_verification(path);
    if (text.empty()) {
      throw InputError(path.string() +
                       ": expected a file of flexneck with a mesh, modes, stresses, a history, a "
                       "sweep, tables or a verification, found another kind of file");
    }
    input.console.result(path.string() + ": " + described_format(path, format) + "\n" + text);
  }
  return true;
}

}  // namespace flexneck::pipeline
