// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/exchange/foreign_file.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <string>

#include "geometry/foundation/ascii.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/input_file.h"
#include "geometry/foundation/text_file.h"
#include "mesher/exchange/file_signature.h"

namespace flexneck::mesher {
namespace {

namespace fs = std::filesystem;

struct FormatRecord {
  std::string_view ending;
  ForeignFormat format;
  const char* safe_name;  ///< decides which reader gmsh takes
};

constexpr std::array<FormatRecord, 8> kFormats = {{
    {".msh", ForeignFormat::msh, "mesh.msh"},
    {".unv", ForeignFormat::unv, "mesh.unv"},
    {".bdf", ForeignFormat::bdf, "mesh.bdf"},
    {".nas", ForeignFormat::bdf, "mesh.bdf"},
    {".inp", ForeignFormat::inp, "mesh.inp"},
    {".step", ForeignFormat::step, "shape.step"},
    {".stp", ForeignFormat::step, "shape.step"},
    {".brep", ForeignFormat::brep, "shape.brep"},
}};

const FormatRecord& record_of(const fs::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](char c) { return lower_case(c); });
  const auto* const found =
      std::find_if(kFormats.begin(), kFormats.end(),
                   [&](const FormatRecord& record) { return record.ending == ending; });
  if (found != kFormats.end()) return *found;
  if (ending == ".geo") {
    throw InputError(file.string() +
                     ": a .geo file is a gmsh script, that is, a program; if you trust it, use the "
                     "key script instead of file");
  }
  std::string known;
  for (const FormatRecord& record : kFormats) known += " " + std::string(record.ending);
  throw InputError(file.string() + ": expected a file with one of the extensions" + known);
}

}  // namespace

ForeignFormat foreign_format_of(const fs::path& file) { return record_of(file).format; }

std::string checked_contents(const fs::path& file) {
  const ForeignFormat format = foreign_format_of(file);
  std::string contents = without_mark(text_of_file(file));
  const std::string problem = signature_problem(format, contents);
  if (!problem.empty()) {
    throw InputError(file.string() + ": not a valid " + file.extension().string() +
                     " file: " + problem);
  }
  return contents;
}

CheckedCopy::CheckedCopy(const fs::path& file)
    : format_(foreign_format_of(file)), path_(folder_ / record_of(file).safe_name) {
  const std::string contents = checked_contents(file);
  std::ofstream copy(path_, std::ios::binary);
  copy << contents;
  copy.close();
  if (!copy) throw ComputationError(path_.string() + ": cannot be written");
}

}  // namespace flexneck::mesher
