// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/exchange/matrix_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "fe_modal/exchange/matrix_market.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/files_read.h"
#include "geometry/foundation/output_file.h"
#include "geometry/foundation/regular_file.h"

namespace flexneck::fe_modal {

namespace {

constexpr std::int32_t kMatrixClass = 1211216;
constexpr std::int32_t kVectorClass = 1211214;

template <typename Number>
std::array<char, sizeof(Number)> big_endian(Number number) {
  auto bytes = std::bit_cast<std::array<char, sizeof(Number)>>(number);
  if constexpr (std::endian::native == std::endian::little) {
    std::reverse(bytes.begin(), bytes.end());
  }
  return bytes;
}

template <typename Number>
void write_number(OutputFile& file, Number number) {
  const auto bytes = big_endian(number);
  file.write({bytes.data(), bytes.size()});
}

class BinaryInput {
 public:
  explicit BinaryInput(const std::filesystem::path& path)
      : path_(path),
        size_(static_cast<std::int64_t>(size_of_file(path))),
        stream_(path, std::ios::binary) {
    if (!stream_) refuse("cannot be read");
  }

  template <typename Number>
  Number number() {
    std::array<char, sizeof(Number)> bytes{};
    if (!stream_.read(bytes.data(), bytes.size())) refuse("the file ends too early");
    if constexpr (std::endian::native == std::endian::little) {
      std::reverse(bytes.begin(), bytes.end());
    }
    return std::bit_cast<Number>(bytes);
  }
  void require_class(std::int32_t expected, const std::string& what) {
    const auto found = number<std::int32_t>();
    if (found != expected) {
      refuse("expected a " + what + " in PETSc's binary format with class " +
             std::to_string(expected) + ", found " + std::to_string(found));
    }
  }
  /// A count of items, for which the file must have room.
  std::int32_t count(std::int64_t bytes_each) {
    const auto found = number<std::int32_t>();
    if (found < 0 || found * bytes_each > size_) refuse("the file ends too early");
    return found;
  }
  [[noreturn]] void refuse(const std::string& problem) const {
    throw InputError(path_.string() + ": " + problem);
  }

 private:
  std::filesystem::path path_;
  std::int64_t size_ = 0;
  std::ifstream stream_;
};

/// PETSc's binary format with 32-bit integers and doubles, big-endian: for a matrix its class,
/// rows, columns, entries, the entries of each row, all columns, all values; for a vector its
/// class, size and values (PETSc manual, MatLoad and VecLoad).
/// @param upper half of a symmetric matrix by rows; both halves are written
void write_petsc_matrix(const std::filesystem::path& path,
                        const Eigen::SparseMatrix<double, Eigen::RowMajor, std::int32_t>& upper) {
  const Eigen::SparseMatrix<double, Eigen::RowMajor, std::int32_t> full =
      upper.selfadjointView<Eigen::Upper>();
  OutputFile file(path);
  for (const Eigen::Index number :
       {static_cast<Eigen::Index>(kMatrixClass), full.rows(), full.cols(), full.nonZeros()}) {
    write_number(file, static_cast<std::int32_t>(number));
  }
  for (Eigen::Index row = 0; row < full.rows(); ++row) {
    write_number(file, full.outerIndexPtr()[row + 1] - full.outerIndexPtr()[row]);
  }
  for (Eigen::Index k = 0; k < full.nonZeros(); ++k) write_number(file, full.innerIndexPtr()[k]);
  for (Eigen::Index k = 0; k < full.nonZeros(); ++k) write_number(file, full.valuePtr()[k]);
  file.commit();
}

MatrixEntries read_petsc_matrix(const std::filesystem::path& path) {
  BinaryInput file(path);
  file.require_class(kMatrixClass, "matrix");
  MatrixEntries matrix;
  matrix.rows = file.count(sizeof(std::int32_t));
  matrix.columns = file.number<std::int32_t>();
  const std::int32_t entries = file.count(sizeof(std::int32_t) + sizeof(double));
  std::vector<std::int32_t> rows;
  rows.reserve(static_cast<std::size_t>(entries));
  for (std::int32_t row = 0; row < matrix.rows; ++row) {
    const auto length = file.number<std::int32_t>();
    if (length < 0 || length > entries - static_cast<std::int32_t>(rows.size())) {
      file.refuse("the lengths of the rows do not add up to the number of entries");
    }
    rows.insert(rows.end(), static_cast<std::size_t>(length), row);
  }
  if (static_cast<std::int32_t>(rows.size()) != entries) {
    file.refuse("the lengths of the rows do not add up to the number of entries");
  }
  std::vector<std::int32_t> columns(rows.size());
  for (std::int32_t& column : columns) {
    column = file.number<std::int32_t>();
    if (column < 0 || column >= matrix.columns) file.refuse("a column is out of range");
  }
  matrix.entries.reserve(rows.size());
  for (std::size_t k = 0; k < rows.size(); ++k) {
    matrix.entries.emplace_back(rows[k], columns[k], file.number<double>());
  }
  return matrix;
}

void write_petsc_vector(const std::filesystem::path& path, const Eigen::VectorXd& values) {
  OutputFile file(path);
  write_number(file, kVectorClass);
  write_number(file, static_cast<std::int32_t>(values.size()));
  for (const double value : values) write_number(file, value);
  file.commit();
}

Eigen::VectorXd read_petsc_vector(const std::filesystem::path& path) {
  BinaryInput file(path);
  file.require_class(kVectorClass, "vector");
  Eigen::VectorXd values(file.count(sizeof(double)));
  for (double& value : values) value = file.number<double>();
  return values;
}

constexpr double kSymmetric = 1e-12;

bool is_binary(const std::filesystem::path& path) {
  if (path.extension() == ".petsc") return true;
  if (path.extension() == ".mtx") return false;
  throw InputError(path.string() +
                   ": expected the extension .mtx (Matrix Market) or .petsc (PETSc binary)");
}

/// Upper half of a symmetric matrix; entries (row, column) and (column, row) of a general matrix
/// must agree and become one.
UpperMatrix upper_half(const std::filesystem::path& path, const MatrixEntries& matrix) {
  const auto refuse = [&](const std::string& problem) {
    throw InputError(path.string() + ": " + problem);
  };
  if (matrix.rows != matrix.columns) {
    refuse("expected a square matrix, found " + std::to_string(matrix.rows) + " x " +
           std::to_string(matrix.columns));
  }
  std::vector<MatrixEntry> lower;
  std::vector<MatrixEntry> upper;
  double largest = 0;
  for (const MatrixEntry& entry : matrix.entries) {
    if (!std::isfinite(entry.value())) refuse("expected finite entries, found NaN or infinity");
    largest = std::max(largest, std::abs(entry.value()));
    if (entry.row() >= entry.col()) lower.emplace_back(entry.col(), entry.row(), entry.value());
    if (entry.row() <= entry.col()) upper.push_back(entry);
  }
  const auto make = [&](std::vector<MatrixEntry>& entries) {
    for (std::int32_t k = 0; k < matrix.rows; ++k) entries.emplace_back(k, k, 0.0);
    UpperMatrix result(matrix.rows, matrix.rows);
    result.setFromTriplets(entries.begin(), entries.end());
    return result;
  };
  const UpperMatrix result = make(lower);
  if (matrix.is_symmetric_by_half) return result;
  const UpperMatrix other = make(upper);
  const UpperMatrix difference = result - other;
  double asymmetry = 0;
  for (Eigen::Index k = 0; k < difference.nonZeros(); ++k) {
    asymmetry = std::max(asymmetry, std::abs(difference.valuePtr()[k]));
  }
  if (asymmetry > kSymmetric * largest) refuse("expected a symmetric matrix");
  return result;
}

}  // namespace

void write_matrix(const std::filesystem::path& path, const UpperMatrix& matrix) {
  is_binary(path) ? write_petsc_matrix(path, matrix) : write_matrix_market(path, matrix);
}

UpperMatrix read_matrix(const std::filesystem::path& path) {
  note_read(path);
  return upper_half(path, is_binary(path) ? read_petsc_matrix(path) : read_matrix_market(path));
}

void write_positions(const std::filesystem::path& path, const Eigen::Matrix3Xd& positions_m) {
  is_binary(path) ? write_petsc_vector(path, positions_m.reshaped())
                  : write_matrix_market_array(path, positions_m.transpose());
}

namespace {

Eigen::Matrix3Xd positions_in(const std::filesystem::path& path) {
  if (!is_binary(path)) {
    const Eigen::MatrixXd table = read_matrix_market_array(path);
    if (table.cols() != 3) {
      throw InputError(path.string() + ": expected three columns, x, y and z, found " +
                       std::to_string(table.cols()));
    }
    return table.transpose();
  }
  const Eigen::VectorXd values = read_petsc_vector(path);
  if (values.size() % 3 != 0) {
    throw InputError(path.string() + ": expected x, y and z of each node, found " +
                     std::to_string(values.size()) + " numbers");
  }
  return values.reshaped(3, values.size() / 3);
}

}  // namespace

Eigen::Matrix3Xd read_positions(const std::filesystem::path& path) {
  note_read(path);
  Eigen::Matrix3Xd positions_m = positions_in(path);
  for (Eigen::Index n = 0; n < positions_m.cols(); ++n) {
    if (positions_m.col(n).allFinite()) continue;
    throw InputError(path.string() + ": node " + std::to_string(n + 1) +
                     " has a coordinate that is not finite");
  }
  return positions_m;
}

}  // namespace flexneck::fe_modal
