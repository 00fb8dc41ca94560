// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "geometry/foundation/atomic_file.h"
#include "geometry/foundation/error.h"
#include "pipeline/cli/commands.h"
#include "pipeline/exchange/export_formats.h"
#include "pipeline/process/result_files.h"

namespace flexneck::pipeline {

namespace {

/// List of the formats offered: ".msh (the mesh for gmsh), …"
template <class Wanted>
std::string offered(const Wanted& wanted) {
  std::string text;
  for (const ExportFormat& format : export_formats())
    if (wanted(format))
      text += (text.empty() ? "" : ", ") + std::string(format.ending) + " (" +
              std::string(format.content) + ")";
  return text;
}

bool any(const ExportFormat& /*format*/) { return true; }

const ExportFormat& format_of(const std::filesystem::path& target, bool is_binary) {
  if (target.empty())
    throw InputError("export: expected --to FILE with one of the extensions " + offered(any));
  const auto formats = export_formats();
  const auto found = std::find_if(formats.begin(), formats.end(), [&](const ExportFormat& format) {
    return target.extension() == format.ending;
  });
  if (found == formats.end())
    throw InputError(target.string() + ": expected a file with one of the extensions " +
                     offered(any));
  if (is_binary && !found->may_be_binary)
    throw InputError(target.string() + ": --binary has no effect on a file of type " +
                     std::string(found->ending));
  return *found;
}

}  // namespace

bool export_file_command(const FileInput& input) {
  const ExportFormat& format = format_of(input.target, input.is_binary);
  if (format.write_file == nullptr)
    throw InputError(input.target.string() + ": expected one of the extensions " +
                     offered([](const ExportFormat& each) { return each.write_file != nullptr; }) +
                     " for an export of the file " + input.files.front().string() +
                     "; other formats are written from the mesh of a study");
  if (input.files.size() != 1)
    throw InputError("export: expected one file, found '" + input.files[1].string() + "' too");
  if (!input.settings.empty() && !format.takes_settings)
    throw InputError("--set: has no effect on the export of a file, which is exported as it is");
  input.console.step("Writing " + input.target.string());
  format.write_file(input);
  return true;
}

bool export_command(const CommandInput& input) {
  const std::filesystem::path& target = input.target;
  const ExportFormat& format = format_of(target, input.is_binary);
  if (format.write == nullptr)
    throw InputError(target.string() +
                     ": name the file to export, as in 'flexneck export FILE --to " +
                     target.string() + "'");
  mesher::MeshFile mesh = read_mesh(input.folder.mesh());
  require_same_inputs(input.folder.mesh(), mesh.provenance, input.study, mesh_values(input.study),
                      "flexneck mesh");
  input.console.step("Writing " + target.string());
  try {
    format.write(input, mesh.mesh);
  } catch (const InputError& error) {
    throw InputError(target.string() + ": " + error.what());
  }
  sync_folder(target.has_parent_path() ? target.parent_path() : ".");
  return true;
}

}  // namespace flexneck::pipeline
