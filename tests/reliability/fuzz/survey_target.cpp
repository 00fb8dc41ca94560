// SPDX-License-Identifier: GPL-3.0-or-later
// Target: flexneck's own readers of .bdf and .unv files; a file that begins with -1 is a .unv.
#include "mesher/exchange/file_signature.h"
#include "mesher/exchange/nastran_cards.h"
#include "mesher/exchange/unv_model.h"
#include "tests/reliability/fuzz/input_folder.h"

using namespace flexneck;
using namespace flexneck::mesher;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text = fuzz::text_of(data, size);
  const bool is_unv = signature_problem(ForeignFormat::unv, text).empty();
  if (!is_unv && !signature_problem(ForeignFormat::bdf, text).empty()) return 0;
  return fuzz::try_reader([&] {
    LeftOut left_out;
    const std::size_t read =
        is_unv ? read_unv(text, 1e-3, left_out).solids.size() : read_nastran_cards(text).size();
    fuzz::require(read <= size, "what is counted stands in the file");
    fuzz::require(left_out.empty() == left_out.text().empty(), "what is left out is told");
  });
}
