// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>
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
#include "pipeline/commands/exports/export_formats.h"
#include "pipeline/document/shipped_files.h"
#include "pipeline/fmu/model_description.h"
#include "pipeline/model/model_file.h"
#include "pipeline/version.h"

namespace flexneck::pipeline {

namespace fs = std::filesystem;

namespace {

/// Of the shared object, as the standard names it: "x86_64-linux".
std::string platform() {
  utsname machine{};
  uname(&machine);
  return std::string(machine.machine) + "-linux";
}

/// Takes the texts and puts them into an archive at once, with one time stamp for all.
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
    constexpr time_t kNoTime = 315532800;  // 1980, with which zip's times begin
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

/// The standard asks for names that differ.
void check_variable_names(const fs::path& model, FmuModel& fmu) {
  std::set<std::string> names;
  for (const FmuVariable& variable : variables_of(fmu))
    if (!names.insert(variable.name).second)
      throw InputError(model.string() + ": two variables of the FMU would be called '" +
                       variable.name + "'; call a channel otherwise");
}

/// The channels without those that a filter would need the whole run for.
std::vector<ChannelSpec> outputs_of(const FileInput& input, const ModelFile& file) {
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
      input.console.warning(input.target.string() + ": the output '" + spec.name +
                            "' is not filtered: a filter runs over the whole of a run");
  }
  return channels;
}

}  // namespace

void export_fmu(const FileInput& input) {
  const fs::path path = named_file(input.files.front());
  const ModelFile file = read_model_file(path, input.settings);
  for (const std::string& warning : file.warnings) input.console.warning(warning);
  if (file.analysis == ModelFile::Analysis::quasi_static)
    throw InputError(path.string() + ": a quasi-static analysis has no motion for an FMU");
  FmuModel fmu{file.model,
               file.solver,
               file.start == ModelFile::Start::equilibrium,
               file.end_time_s,
               file.output.interval_s,
               outputs_of(input, file)};
  check_variable_names(path, fmu);
  std::string bytes;
  try {
    bytes = bytes_of(fmu);
  } catch (const InputError& error) {
    throw InputError(path.string() + ": " + error.what());
  }
  const std::string name = path.stem().string();
  const std::string identifier = c_identifier(name);
  const std::string description = model_description(
      {name, identifier, token_of(bytes), fmt::format("flexneck {} ({})", kVersion, kGitHash)},
      fmu);
  const std::string object = text_of_file(library_file("flexneck_fmu.so"));
  const TemporaryFolder folder;
  const fs::path made = folder / "model.fmu";
  ZipFile zip(made);
  zip.add("modelDescription.xml", description);
  zip.add(fmt::format("binaries/{}/{}.so", platform(), identifier), object);
  zip.add("resources/model.bin", bytes);
  zip.commit();
  write_text(input.target, text_of_file(made));
}

}  // namespace flexneck::pipeline
