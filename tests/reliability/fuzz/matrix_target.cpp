// SPDX-License-Identifier: GPL-3.0-or-later
// Target: matrices and positions from other programs, Matrix Market or PETSc binary. The first byte
// selects format and kind.
#include <cmath>

#include "fe_modal/exchange/matrix_file.h"
#include "tests/reliability/fuzz/input_folder.h"

using namespace flexneck;

namespace {

void check(const fe_modal::UpperMatrix& matrix) {
  fuzz::require(matrix.rows() == matrix.cols(), "a matrix is square");
  for (Eigen::Index row = 0; row < matrix.outerSize(); ++row)
    for (fe_modal::UpperMatrix::InnerIterator entry(matrix, row); entry; ++entry)
      fuzz::require(
          entry.col() >= row && entry.col() < matrix.cols() && std::isfinite(entry.value()),
          "an entry is finite and in the upper half");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::InputFolder folder;
  if (size == 0) return 0;
  const std::string name = (data[0] & 1) != 0 ? "matrix.petsc" : "matrix.mtx";
  const std::filesystem::path path = folder.with(name, fuzz::text_of(data + 1, size - 1));
  return fuzz::try_reader([&] {
    if ((data[0] & 2) == 0) return check(fe_modal::read_matrix(path));
    fuzz::require(fe_modal::read_positions(path).allFinite(), "positions are finite");
  });
}
