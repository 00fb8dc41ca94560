// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/exchange/fmu_export.h"

#include <dlfcn.h>
#include <memory>
#include <muParserDLL.h>
#include <set>
#include <string>
#include <sys/utsname.h>
#include <zip.h>

#include <fmt/core.h>

#include "geometry/foundation/error.h"
#include "geometry/foundation/input_file.h"
#include "geometry/foundation/output_file.h"
#include "geometry/foundation/temporary_folder.h"
#include "multibody/history/recorder.h"
#include "pipeline/exchange/export_formats.h"
#include "pipeline/exchange/fmu/model_description.h"
#include "pipeline/language/document/shipped_files.h"
#include "pipeline/language/model/model_file.h"
#include "pipeline/version.h"

namespace flexneck::pipeline {

namespace fs = std::filesystem;
using multibody::SteppedRun;

namespace {

/// Platform of the shared object in the standard's notation: "x86_64-linux".
std::string platform() {
  utsname machine{};
  uname(&machine);
  return std::string(machine.machine) + "-linux";
}

/// A zip archive: collects texts and writes them at once, with one time stamp for all.
class ZipFile {
 public:
  explicit ZipFile(const fs::path& path)
      : archive_(zip_open(path.c_str(), ZIP_CREATE | ZIP_TRUNCATE, nullptr), zip_discard) {
    if (!archive_) throw ComputationError(path.string() + ": cannot be written");
  }
  /// @param text  must outlive commit()
  void add(const std::string& name, const std::string& text) {
    zip_source_t* const source = zip_source_buffer(archive_.get(), text.data(), text.size(), 0);
    const zip_int64_t index =
        source == nullptr ? -1
                          : zip_file_add(archive_.get(), name.c_str(), source, ZIP_FL_ENC_UTF_8);
    if (index < 0) {
      zip_source_free(source);
      fail();
    }
    constexpr time_t kNoTime = 315532800;  // 1980-01-01, the earliest time in a zip archive
    zip_file_set_mtime(archive_.get(), static_cast<zip_uint64_t>(index), kNoTime, 0);
  }
  void commit() {
    if (zip_close(archive_.get()) != 0) fail();
    static_cast<void>(archive_.release());
  }

 private:
  [[noreturn]] void fail() const {
    throw ComputationError(std::string("libzip: ") + zip_strerror(archive_.get()));
  }

  std::unique_ptr<zip_t, decltype(&zip_discard)> archive_;
};

/// Fails if two variables have the same name, which the standard forbids.
void check_variable_names(const fs::path& model, FmuModel& fmu) {
  std::set<std::string> names;
  for (const FmuVariable& variable : variables_of(fmu))
    if (!names.insert(variable.name).second)
      throw InputError(model.string() + ": two variables of the FMU would have the name '" +
                       variable.name + "'; rename a channel");
}

/// The channels, with their filters removed, since a filter needs the whole run.
std::vector<ChannelSpec> outputs_of(const ModelFile& file, const fs::path& target,
                                    const Console& console) {
  if (file.output.channels.empty()) {
    multibody::OutputOptions one;
    one.end_time_s = one.begin_time_s = file.model.start.time_s;
    return all_channels(multibody::Recorder(file.model, one).take());
  }
  std::vector<ChannelSpec> channels;
  for (const ChannelSpec& spec : file.output.channels) {
    channels.push_back(spec);
    channels.back().filter.reset();
    if (spec.filter)
      console.warning(target.string() + ": the output '" + spec.name +
                      "' is not filtered, since a filter needs the whole run");
  }
  return channels;
}

SteppedRun::Kind kind_of(const ModelFile& file) {
  if (file.analysis == ModelFile::Analysis::quasi_static) return SteppedRun::Kind::quasi_static;
  return file.start == ModelFile::Start::equilibrium ? SteppedRun::Kind::from_equilibrium
                                                     : SteppedRun::Kind::motion;
}

/// Path of the muParser library that this program has loaded.
fs::path parser_file() {
  Dl_info found;
  if (dladdr(reinterpret_cast<const void*>(&mupGetVersion), &found) == 0)
    throw ComputationError("the muParser library, which an FMU with formulas needs, was not found");
  return found.dli_fname;
}

}  // namespace

void export_fmu(const FileInput& input) {
  const fs::path path = named_file(input.files.front());
  const ModelFile file = read_model_file(path, input.settings);
  for (const std::string& warning : file.warnings) input.console.warning(warning);
  write_fmu(file, input.target, input.console);
}

void write_fmu(const ModelFile& file, const fs::path& target, const Console& console) {
  FmuModel fmu{file.model,
               file.solver,
               kind_of(file),
               file.end_time_s,
               file.output.interval_s,
               outputs_of(file, target, console)};
  check_variable_names(file.file, fmu);
  std::vector<FormulaForce> formulas;
  try {
    formulas = formula_forces_of(fmu.model);
  } catch (const InputError& error) {
    throw InputError(file.file.string() + ": " + error.what());
  }
  const std::string bytes = bytes_of(fmu, formulas);
  const std::string name = file.file.stem().string();
  const std::string identifier = c_identifier(name);
  const std::string description = model_description(
      {name, identifier, token_of(bytes), fmt::format("flexneck {} ({})", kVersion, kGitHash),
       file.has_expressions
           ? fmt::format("Resolution of expressions of time: {} s, up to the time {} s",
                         exact_text(file.solver.resolution_s), exact_text(file.end_time_s))
           : ""},
      fmu);
  // Names in the FMU with the contents.
  std::vector<std::pair<std::string, std::string>> contents = {
      {"modelDescription.xml", description}, {"resources/model.bin", bytes}};
  const std::string binaries = fmt::format("binaries/{}/", platform());
  if (formulas.empty()) {
    contents.emplace_back(binaries + identifier + ".so",
                          text_of_file(library_file("flexneck_fmu.so")));
  } else {
    contents.emplace_back(binaries + identifier + ".so",
                          text_of_file(library_file("flexneck_fmu_formulas.so")));
    contents.emplace_back(binaries + parser_file().filename().string(),
                          text_of_file(parser_file()));
    contents.emplace_back("documentation/licenses/muparser.txt",
                          text_of_file(shipped_file("pipeline/exchange/fmu/muparser.txt")));
  }
  const TemporaryFolder folder;
  const fs::path made = folder / "model.fmu";
  ZipFile zip(made);
  for (const auto& [each, text] : contents) zip.add(each, text);
  zip.commit();
  write_text(target, text_of_file(made));
}

}  // namespace flexneck::pipeline
