// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/exchange/matrix_market.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/foundation/ascii.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/output_file.h"
#include "geometry/foundation/regular_file.h"
#include "geometry/foundation/text_file.h"

namespace flexneck::fe_modal {
namespace {

constexpr std::string_view kBlanks = " \t\r\v\f";

/// Reads the numbers of a file line by line, without comments.
class NumberLines {
 public:
  explicit NumberLines(const std::filesystem::path& path)
      : path_(path), size_(static_cast<double>(size_of_file(path))), stream_(path) {
    if (!stream_) throw InputError(path.string() + ": cannot be read");
    next_line();
    header_ = without_mark(line_);
    std::transform(header_.begin(), header_.end(), header_.begin(),
                   [](char c) { return lower_case(c); });
    if (!header_.starts_with("%%matrixmarket matrix")) {
      refuse("expected a file whose first line starts with %%MatrixMarket matrix");
    }
  }

  bool header_has(const std::string& word) const {
    return header_.find(" " + word) != std::string::npos;
  }

  /// The numbers of the next line that has any; there must be `count` of them.
  std::vector<double> next(std::size_t count) {
    do {
      next_line();
    } while (line_.starts_with('%') || line_.find_first_not_of(kBlanks) == std::string::npos);
    std::vector<double> numbers;
    const char* place = line_.data();
    const char* const end = place + line_.size();
    for (;;) {
      while (place != end && kBlanks.find(*place) != std::string_view::npos) ++place;
      if (place == end) break;
      // Fortran's plus sign, which from_chars does not accept.
      if (*place == '+' && place + 1 != end) ++place;
      double number = 0;
      const auto [after, error] = std::from_chars(place, end, number);
      if (error != std::errc()) refuse("expected a number");
      numbers.push_back(number);
      place = after;
    }
    if (numbers.size() != count) {
      refuse("expected " + std::to_string(count) + " numbers, found " +
             std::to_string(numbers.size()));
    }
    return numbers;
  }

  std::int32_t integer(double number, double least, double most) const {
    if (!(number >= least && number <= most) ||
        number != static_cast<double>(static_cast<std::int64_t>(number))) {
      refuse("expected a whole number from " + std::to_string(static_cast<std::int64_t>(least)) +
             " to " + std::to_string(static_cast<std::int64_t>(most)));
    }
    return static_cast<std::int32_t>(number);
  }

  /// A number of rows, columns or entries, no larger than the number of characters in the file.
  std::int32_t count(double number, double least) const {
    constexpr double kMost = std::numeric_limits<std::int32_t>::max();
    return integer(number, least, std::min(kMost, size_));
  }
  /// Size of the file in bytes.
  double size() const { return size_; }

  [[noreturn]] void refuse(const std::string& problem) const {
    throw InputError(path_.string() + ":" + std::to_string(number_) + ": " + problem);
  }

 private:
  void next_line() {
    ++number_;
    if (!std::getline(stream_, line_)) refuse("the file ends too early");
  }

  std::filesystem::path path_;
  double size_ = 0;
  std::ifstream stream_;
  std::string header_;
  std::string line_;
  std::int64_t number_ = 0;
};

}  // namespace

void write_matrix_market(const std::filesystem::path& path,
                         const Eigen::SparseMatrix<double, Eigen::RowMajor, std::int32_t>& upper) {
  OutputFile file(path);
  const std::string size = std::to_string(upper.rows());
  file.write("%%MatrixMarket matrix coordinate real symmetric\n" + size + " " + size + " " +
             std::to_string(upper.nonZeros()) + "\n");
  for (Eigen::Index row = 0; row < upper.rows(); ++row) {
    const std::string column = " " + std::to_string(row + 1) + " ";
    for (decltype(upper.nonZeros()) k = upper.outerIndexPtr()[row];
         k < upper.outerIndexPtr()[row + 1]; ++k) {
      file.write(std::to_string(upper.innerIndexPtr()[k] + 1) + column +
                 exact_text(upper.valuePtr()[k]) + "\n");
    }
  }
  file.commit();
}

MatrixEntries read_matrix_market(const std::filesystem::path& path) {
  NumberLines lines(path);
  const bool is_half = lines.header_has("symmetric");
  if (!lines.header_has("coordinate") || !lines.header_has("real") ||
      !(is_half || lines.header_has("general"))) {
    lines.refuse("expected \"coordinate real symmetric\" or \"coordinate real general\"");
  }
  const std::vector<double> sizes = lines.next(3);
  MatrixEntries matrix{lines.count(sizes[0], 1), lines.count(sizes[1], 1), is_half, {}};
  const std::int32_t count = lines.count(sizes[2], 0);
  matrix.entries.reserve(static_cast<std::size_t>(count));
  for (std::int32_t k = 0; k < count; ++k) {
    const std::vector<double> entry = lines.next(3);
    const std::int32_t row = lines.integer(entry[0], 1, matrix.rows) - 1;
    const std::int32_t column = lines.integer(entry[1], 1, matrix.columns) - 1;
    if (is_half && column > row) lines.refuse("expected only entries of the lower triangle");
    matrix.entries.emplace_back(row, column, entry[2]);
  }
  return matrix;
}

void write_matrix_market_array(const std::filesystem::path& path, const Eigen::MatrixXd& table) {
  OutputFile file(path);
  file.write("%%MatrixMarket matrix array real general\n" + std::to_string(table.rows()) + " " +
             std::to_string(table.cols()) + "\n");
  for (const double value : table.reshaped()) file.write(exact_text(value) + "\n");
  file.commit();
}

Eigen::MatrixXd read_matrix_market_array(const std::filesystem::path& path) {
  NumberLines lines(path);
  if (!lines.header_has("array") || !lines.header_has("real") || !lines.header_has("general")) {
    lines.refuse("expected \"array real general\"");
  }
  const std::vector<double> sizes = lines.next(2);
  if (!(sizes[0] * sizes[1] <= lines.size()))
    lines.refuse("the sizes require more numbers than the file contains");
  Eigen::MatrixXd table(lines.count(sizes[0], 1), lines.count(sizes[1], 1));
  for (double& value : table.reshaped()) value = lines.next(1)[0];
  return table;
}

}  // namespace flexneck::fe_modal
