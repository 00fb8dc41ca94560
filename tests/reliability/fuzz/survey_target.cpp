// SPDX-License-Identifier: GPL-3.0-or-later
// What we read of .bdf and .unv files beside gmsh; a file that begins with -1 is a .unv.
#include "mesher/exchange/file_signature.h"
#include "mesher/exchange/file_survey.h"
#include "tests/reliability/fuzz/input_folder.h"

using namespace flexneck;
using namespace flexneck::mesher;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text = fuzz::text_of(data, size);
  const bool is_unv = signature_problem(ForeignFormat::unv, text).empty();
  if (!is_unv && !signature_problem(ForeignFormat::bdf, text).empty()) return 0;
  return fuzz::try_reader([&] {
    LeftOut left_out;
    const FileSurvey survey =
        is_unv ? survey_unv(text, 1e-3, left_out) : survey_nastran(text, left_out);
    std::size_t solids = 0;
    for (const auto& [nodes, count] : survey.solids) solids += count;
    fuzz::require(solids <= size && survey.nodes <= size, "what is counted stands in the file");
    fuzz::require(left_out.empty() == left_out.text().empty(), "what is left out is told");
  });
}
