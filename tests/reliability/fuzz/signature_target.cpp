// SPDX-License-Identifier: GPL-3.0-or-later
// Target: checks of a mesh or shape before gmsh or OpenCASCADE read it; the first byte selects the
// format.
#include <array>

#include "mesher/exchange/file_signature.h"
#include "tests/reliability/fuzz/input_folder.h"

using namespace flexneck;
using namespace flexneck::mesher;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::array kFormats = {ForeignFormat::msh, ForeignFormat::unv,  ForeignFormat::bdf,
                                   ForeignFormat::inp, ForeignFormat::step, ForeignFormat::brep};
  if (size == 0) return 0;
  const std::string text = fuzz::text_of(data + 1, size - 1);
  const ForeignFormat format = kFormats[data[0] % kFormats.size()];
  const std::string problem = signature_problem(format, text);
  fuzz::require(problem.find('\n') == std::string::npos, "a problem is told in one line");
  if (!problem.empty() || format != ForeignFormat::msh) return 0;
  // gmsh takes anything but a section for the name of a file to merge, or for a script.
  fuzz::require(text.starts_with("$MeshFormat"), "a .msh begins with its first section");
  return 0;
}
