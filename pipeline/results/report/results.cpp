// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/results/report/results.h"

#include <algorithm>
#include <functional>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "geometry/foundation/ascii.h"
#include "geometry/foundation/error.h"
#include "pipeline/process/result_files.h"
#include "pipeline/run/results_folder.h"

namespace flexneck::pipeline {

namespace fs = std::filesystem;

namespace {

/// Index behind the digits that begin at an index.
std::size_t end_of_number(const std::string& text, std::size_t place) {
  while (place < text.size() && is_digit(text[place])) ++place;
  return place;
}

/// Names of the files in a folder, in order.
std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  if (!fs::exists(folder)) return names;
  for (const auto& entry : fs::directory_iterator(folder)) {
    names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end(), comes_before);
  return names;
}

/// Reads the files of a folder one by one into results.
class Reader {
 public:
  Reader(const fs::path& folder, const Study& study) : folder_(folder), study_(study) {}

  Results take() && {
    // The study has the cases in the order of interest; a variant follows its case.
    std::sort(results_.experiments.begin(), results_.experiments.end(),
              [&](const Experiment& a, const Experiment& b) {
                const auto place = [&](const Experiment& run) {
                  return std::pair(run.kind, place_of(run));
                };
                return place(a) != place(b) ? place(a) < place(b) : comes_before(a.name, b.name);
              });
    return std::move(results_);
  }

  void mesh() {
    require("mesh.h5", "the mesh", "flexneck mesh", [&](const fs::path& path) {
      mesher::MeshFile file = read_mesh(path);
      if (belongs("mesh.h5", file.provenance)) results_.mesh = std::move(file.mesh);
      return file.provenance;
    });
  }

  void modes() {
    require("modes.h5", "the modes", "flexneck modes", [&](const fs::path& path) {
      fe_modal::ModalBodyFile file = read_modal_body(path);
      if (belongs("modes.h5", file.provenance)) results_.modes = std::move(file.body);
      return file.provenance;
    });
  }

  void verification() {
    require("verification.json", "the comparison with published figures", "flexneck verify",
            [&](const fs::path& path) {
              VerificationFile file = read_verification(path);
              if (belongs("verification.json", file.provenance))
                results_.verification = std::move(file.table);
              return file.provenance;
            });
  }

  void experiments(Experiment::Kind kind, const std::string& prefix, const std::string& command) {
    for (const std::string& name : names_in(folder_)) {
      if (!name.starts_with(prefix) || !name.ends_with(".h5")) continue;
      read(name, command, [&](const fs::path& path) {
        multibody::HistoryFile file = read_history(path);
        Provenance provenance = file.provenance;
        if (!belongs(name, provenance)) return provenance;
        add_warnings(name, file.history);
        results_.experiments.push_back(
            {kind, path.stem().string().substr(prefix.size()), std::move(file)});
        return provenance;
      });
    }
    for (const CaseSection& experiment : study_.cases) {
      const bool is_pendulum = experiment.kind == CaseSection::Kind::pendulum;
      if (is_pendulum != (kind == Experiment::Kind::pendulum)) continue;
      if (results_.find(kind, experiment.name) == nullptr) {
        miss(prefix + experiment.name + ".h5", "the case " + experiment.name, command);
      }
    }
  }

  void tables() {
    for (const std::string& name : names_in(folder_)) {
      if (name == kComparisonTables) continue;
      if (!name.ends_with(".json") || !holds_tables(folder_ / name)) continue;
      read(name, "flexneck run", [&](const fs::path& path) {
        TableFile file = read_tables(path);
        if (belongs(name, file.provenance))
          std::move(file.tables.begin(), file.tables.end(), std::back_inserter(results_.tables));
        return file.provenance;
      });
    }
  }

  /// Warns if different programs made the files, which then may not belong together.
  void compare_versions() {
    std::set<std::string> programs;
    for (const ResultFile& file : results_.files) {
      programs.insert(file.provenance.program + " (" + file.provenance.git_hash + ")");
    }
    if (programs.size() < 2) return;
    std::string list;
    for (const std::string& program : programs) list += (list.empty() ? "" : ", ") + program;
    results_.warnings.push_back("The files in this folder were made by different versions: " +
                                list + ". Make them again with 'flexneck run --force'.");
  }

  void tell_left_out() {
    constexpr std::size_t kShown = 3;
    for (const auto& [source, names] : left_out_) {
      const auto shown = static_cast<std::ptrdiff_t>(std::min(kShown, names.size()));
      results_.warnings.push_back(fmt::format(
          "{} of this folder, not made from the current {}, {} omitted: {}{}; 'flexneck run' makes "
          "all results consistent.",
          names.size() == 1 ? "A file" : fmt::format("{} files", names.size()), source,
          names.size() == 1 ? "is" : "are", fmt::join(names.begin(), names.begin() + shown, ", "),
          names.size() > kShown ? ", …" : ""));
    }
  }

 private:
  using ReadFile = std::function<Provenance(const fs::path&)>;

  /// Index among the study's cases of the run's case, or of its base case; other runs come last.
  std::size_t place_of(const Experiment& run) const {
    const bool is_pendulum = run.kind == Experiment::Kind::pendulum;
    const auto found =
        std::find_if(study_.cases.begin(), study_.cases.end(), [&](const CaseSection& each) {
          return (each.kind == CaseSection::Kind::pendulum) == is_pendulum &&
                 (run.name == each.name || run.name.starts_with(each.name + "-"));
        });
    return static_cast<std::size_t>(found - study_.cases.begin());
  }

  void read(const std::string& name, const std::string& command, const ReadFile& read_file) {
    const fs::path path = folder_ / name;
    try {
      const Provenance provenance = read_file(path);
      if (is_left_out(name)) return;
      results_.files.push_back({name, hash_of_file(path.string()), provenance});
      require_same_inputs(name, provenance, study_, {}, command);
    } catch (const InputError& error) {
      results_.warnings.emplace_back(error.what());
    }
  }

  void require(const std::string& name, const std::string& what, const std::string& command,
               const ReadFile& read_file) {
    fs::exists(folder_ / name) ? read(name, command, read_file) : miss(name, what, command);
  }

  void miss(const std::string& name, const std::string& what, const std::string& command) {
    results_.missing.push_back(
        fmt::format("{}, {}, is not in this folder; '{}' creates it.", name, what, command));
  }

  void add_warnings(const std::string& name, const multibody::History& history) {
    for (const std::string& warning : history.warnings)
      results_.run_warnings.push_back(name + ": " + warning);
    if (!history.incomplete.empty())
      results_.run_warnings.push_back(name + ": the run ended early: " + history.incomplete);
  }

  /// Returns whether a file was made from the folder's current files, and these from theirs; else
  /// it is left out. Files are read after those that they are made from.
  bool belongs(const std::string& name, const Provenance& provenance) {
    std::string source = replaced_source(folder_ / name, provenance);
    for (const InputFile& input : provenance.inputs)
      if (source.empty() && is_left_out(input.name)) source = input.name;
    if (!source.empty()) left_out_[source].push_back(name);
    return source.empty();
  }

  bool is_left_out(const std::string& name) const {
    return std::any_of(left_out_.begin(), left_out_.end(), [&](const auto& of_source) {
      const std::vector<std::string>& names = of_source.second;
      return std::find(names.begin(), names.end(), name) != names.end();
    });
  }

  fs::path folder_;
  const Study& study_;
  Results results_;
  /// Files left out, keyed by the replaced file.
  std::map<std::string, std::vector<std::string>> left_out_;
};

}  // namespace

bool comes_before(const std::string& a, const std::string& b) {
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < a.size() && j < b.size()) {
    if (is_digit(a[i]) && is_digit(b[j])) {
      const std::size_t a_end = end_of_number(a, i);
      const std::size_t b_end = end_of_number(b, j);
      const std::string x = a.substr(i, a_end - i);
      const std::string y = b.substr(j, b_end - j);
      if (x.size() != y.size()) return x.size() < y.size();
      if (x != y) return x < y;
      i = a_end;
      j = b_end;
    } else {
      if (a[i] != b[j]) return a[i] < b[j];
      ++i;
      ++j;
    }
  }
  return a.size() - i < b.size() - j;
}

std::vector<std::string> Results::all_warnings() const {
  std::vector<std::string> all = warnings;
  all.insert(all.end(), run_warnings.begin(), run_warnings.end());
  return all;
}

void refuse_without_results(const fs::path& folder) {
  const std::vector<std::string> names = names_in(folder);
  const auto run = std::find_if(names.begin(), names.end(), [&](const std::string& name) {
    return name.ends_with(".h5") && fs::exists((folder / name).replace_extension(".csv"));
  });
  if (run != names.end())
    throw InputError(folder.string() +
                     ": contains runs of models, for which there is no page; 'flexneck info " +
                     (folder / *run).string() + "' describes one of them, and its curves are in " +
                     fs::path(*run).replace_extension(".csv").string());
  throw InputError(folder.string() + ": contains no results; 'flexneck run -o " + folder.string() +
                   "' creates those of the built-in study");
}

const Experiment* Results::find(Experiment::Kind kind, const std::string& name) const {
  const auto found =
      std::find_if(experiments.begin(), experiments.end(),
                   [&](const Experiment& each) { return each.kind == kind && each.name == name; });
  return found == experiments.end() ? nullptr : &*found;
}

Results read_results(const fs::path& folder, const Study& study) {
  Reader reader(folder, study);
  reader.mesh();
  reader.modes();
  reader.experiments(Experiment::Kind::pendulum, "pendulum-", "flexneck pendulum");
  reader.experiments(Experiment::Kind::static_test, "static-", "flexneck static");
  reader.verification();
  reader.tables();
  reader.compare_versions();
  reader.tell_left_out();
  return std::move(reader).take();
}

}  // namespace flexneck::pipeline
