// SPDX-License-Identifier: GPL-3.0-or-later
#include <fstream>
#include <limits>
#include <string>

#include <catch2/catch.hpp>

#include "fe_modal/algebra/petsc_handles.h"
#include "fe_modal/exchange/matrix_file.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/temporary_folder.h"
#include "tests/fe_modal/dense.h"

using Catch::Matchers::Contains;

namespace flexneck::fe_modal {
namespace {

UpperMatrix example() {
  const std::vector<Eigen::Triplet<double, std::int32_t>> entries = {
      {0, 0, 4.0 / 3}, {0, 2, -1e-17}, {1, 1, 5e300}, {2, 2, 7}};
  UpperMatrix matrix(3, 3);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

Eigen::MatrixXd full(const UpperMatrix& matrix) {
  return Eigen::MatrixXd(matrix).selfadjointView<Eigen::Upper>();
}

void check_refused(const std::string& ending, const std::string& content,
                   const std::string& reason) {
  const TemporaryFolder folder;
  const auto path = folder / ("matrix" + ending);
  std::ofstream(path) << content;
  INFO(content);
  CHECK_THROWS_WITH(read_matrix(path), Contains(path.string()) && Contains(reason));
}

}  // namespace

TEST_CASE("matrices and positions come back from files bit by bit") {
  const TemporaryFolder folder;
  const Eigen::Matrix3Xd positions = Eigen::Matrix3Xd::Random(3, 5);
  for (const char* const ending : {".mtx", ".petsc"}) {
    const auto path = folder / (std::string("file") + ending);
    write_matrix(path, example());
    CHECK(full(read_matrix(path)) == full(example()));
    write_positions(path, positions);
    CHECK(read_positions(path) == positions);
  }
}

TEST_CASE("PETSc reads the binary matrices, and its own are read") {
  const TemporaryFolder folder;
  write_matrix(folder / "ours.petsc", example());
  PetscViewer viewer = nullptr;
  require(PetscViewerBinaryOpen(PETSC_COMM_SELF, (folder / "ours.petsc").c_str(), FILE_MODE_READ,
                                &viewer),
          "testing");
  MatHandle matrix;
  require(MatCreate(PETSC_COMM_SELF, matrix.out()), "testing");
  require(MatSetType(matrix.get(), MATSEQAIJ), "testing");
  require(MatLoad(matrix.get(), viewer), "testing");
  require(PetscViewerDestroy(&viewer), "testing");
  CHECK(dense(matrix.get()) == full(example()));
  require(PetscViewerBinaryOpen(PETSC_COMM_SELF, (folder / "theirs.petsc").c_str(), FILE_MODE_WRITE,
                                &viewer),
          "testing");
  require(MatView(matrix.get(), viewer), "testing");
  require(PetscViewerDestroy(&viewer), "testing");
  CHECK(full(read_matrix(folder / "theirs.petsc")) == full(example()));
}

TEST_CASE("what is wrong with a matrix is said with file and line") {
  const std::string head = "%%MatrixMarket matrix coordinate real ";
  check_refused(".mtx", "1 1 1\n", "MatrixMarket");
  check_refused(".mtx", head + "skew-symmetric\n1 1 0\n", "symmetric");
  check_refused(".mtx", head + "symmetric\n2 2 2\n1 1 1\n", ":4: the file ends too early");
  check_refused(".mtx", head + "symmetric\n2 2 1\n1 2 1\n",
                ":3: expected only entries of the lower");
  check_refused(".mtx", head + "symmetric\n2 2 1\n3 1 1\n", ":3: expected a whole number");
  check_refused(".mtx", head + "symmetric\n2 2 1\n1 1 x\n", ":3: expected a number");
  check_refused(".mtx", head + "symmetric\n2 2 1\n1 1 nan\n", "expected finite entries");
  check_refused(".mtx", head + "general\n2 2 1\n1 2 1\n", "expected a symmetric matrix");
  check_refused(".mtx", head + "general\n2 3 1\n1 2 1\n", "square");
  check_refused(".petsc", "something else", "PETSc");
  check_refused(".csv", "", ".mtx");
}

TEST_CASE("a mark of UTF-8 at the beginning of a Matrix Market file is passed over") {
  const TemporaryFolder folder;
  std::ofstream(folder / "marked.mtx")
      << "\xef\xbb\xbf%%MatrixMarket matrix coordinate real symmetric\n3 3 1\n1 1 2.5\n";
  CHECK(full(read_matrix(folder / "marked.mtx"))(0, 0) == 2.5);
}

TEST_CASE("sizes that a file cannot have are refused before they take memory") {
  const std::string head = "%%MatrixMarket matrix coordinate real symmetric\n";
  check_refused(".mtx", head + "2147483647 2147483647 1\n1 1 1\n", ":2: expected a whole number");
  check_refused(".mtx", head + "1 1 2147483647\n1 1 1\n", ":2: expected a whole number");
  const TemporaryFolder folder;
  std::ofstream(folder / "table.mtx")
      << "%%MatrixMarket matrix array real general\n2147483647 2147483647\n1\n";
  CHECK_THROWS_WITH(read_positions(folder / "table.mtx"),
                    Contains(":2: the sizes require more numbers"));
  for (const char* const name : {"folder.mtx", "folder.petsc"}) {
    std::filesystem::create_directory(folder / name);
    CHECK_THROWS_AS(read_matrix(folder / name), InputError);
  }
}

TEST_CASE("positions that are not finite are refused by their node") {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const TemporaryFolder folder;
  Eigen::Matrix3Xd positions = Eigen::Matrix3Xd::Zero(3, 4);
  positions(1, 2) = kNan;
  for (const char* const ending : {".mtx", ".petsc"}) {
    const auto path = folder / (std::string("file") + ending);
    write_positions(path, positions);
    CHECK_THROWS_WITH(read_positions(path), Contains(path.string()) && Contains("node 3"));
  }
}

}  // namespace flexneck::fe_modal
