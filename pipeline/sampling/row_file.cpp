// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/sampling/row_file.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fcntl.h>
#include <sys/types.h>
#include <unistd.h>
#include <utility>

#include "geometry/foundation/content_hash.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/output_file.h"
#include "geometry/foundation/printable.h"

namespace flexneck::pipeline {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kHashDigits = 16;

fs::path curves_beside(const fs::path& path) { return path.string() + ".curves"; }

std::string heading(const RowFormat& format) { return "flexneck rows 1," + format.definition; }

std::string bytes_of(const Eigen::VectorXd& curves) {
  std::string bytes(static_cast<std::size_t>(curves.size()) * sizeof(double), '\0');
  if (!bytes.empty()) std::memcpy(bytes.data(), curves.data(), bytes.size());
  return bytes;
}

std::string hash_of(const std::string& line, const std::string& curves) {
  return hash_of_text(line + '\n' + curves).substr(0, kHashDigits);
}

/// A number up to a comma, which goes, too.
template <class Number>
bool take(std::string_view& text, Number& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const auto length = static_cast<std::size_t>(end - text.data());
  if (error != std::errc() || length >= text.size() || *end != ',') return false;
  text.remove_prefix(length + 1);
  return true;
}

bool parse(std::string_view text, Eigen::Index figures, RowResult& result) {
  result.figures.resize(figures);
  if (!take(text, result.row)) return false;
  for (double& figure : result.figures)
    if (!take(text, figure)) return false;
  result.problem = text;
  return true;
}

FileDescriptor opened(const fs::path& path, std::uint64_t keep) {
  FileDescriptor file(uninterrupted(
      [&] { return ::open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666); }));
  if (!file ||
      uninterrupted([&] { return ::ftruncate(file.get(), static_cast<off_t>(keep)); }) != 0)
    throw InputError(path.string() + ": cannot be written (" + std::strerror(errno) +
                     "); choose another folder with -o");
  return file;
}

}  // namespace

RowReader::RowReader(const fs::path& path, RowFormat format)
    : format_(std::move(format)), lines_(path, std::ios::binary) {
  std::string first;
  if (!std::getline(lines_, first) || lines_.eof()) return;
  if (first != heading(format_)) {
    is_of_another_ = true;
    lines_.setstate(std::ios::failbit);
    return;
  }
  end_ = first.size() + 1;
  if (format_.curve_values > 0) curves_.open(curves_beside(path), std::ios::binary);
}

bool RowReader::next(RowResult& result) {
  std::string line;
  if (!std::getline(lines_, line) || lines_.eof()) return false;  // a last line without its end
  const auto stop = [&] {
    lines_.setstate(std::ios::failbit);
    return false;
  };
  if (line.size() < kHashDigits + 1) return stop();
  const std::string text = line.substr(0, line.size() - kHashDigits - 1);
  if (!parse(text, format_.figures, result)) return stop();
  result.curves.resize(format_.curve_values);
  std::string bytes(static_cast<std::size_t>(format_.curve_values) * sizeof(double), '\0');
  if (!bytes.empty() && !curves_.read(bytes.data(), static_cast<std::streamsize>(bytes.size())))
    return stop();
  if (line.substr(text.size()) != "|" + hash_of(text, bytes)) return stop();
  if (!bytes.empty()) std::memcpy(result.curves.data(), bytes.data(), bytes.size());
  end_ += line.size() + 1;
  end_of_curves_ += bytes.size();
  return true;
}

RowWriter::RowWriter(const fs::path& path, const RowFormat& format, const RowReader& after)
    : path_(path), lines_(opened(path, after.end())) {
  if (format.curve_values > 0) curves_ = opened(curves_beside(path), after.end_of_curves());
  if (after.end() == 0) write(lines_, heading(format) + "\n");
}

void RowWriter::append(const RowResult& result) {
  std::string line = std::to_string(result.row) + ",";
  for (const double figure : result.figures) line += exact_text(figure) + ",";
  line += printable(result.problem);
  const std::string curves = bytes_of(result.curves);
  // The curves first: a row is there once its line is.
  if (curves_) write(curves_, curves);
  write(lines_, line + "|" + hash_of(line, curves) + "\n");
}

void RowWriter::write(const FileDescriptor& file, std::string_view bytes) const {
  while (!bytes.empty()) {
    const ssize_t count =
        uninterrupted([&] { return ::write(file.get(), bytes.data(), bytes.size()); });
    if (count <= 0)
      throw ComputationError(path_.string() + ": cannot be written (" + std::strerror(errno) +
                             "); the rows before are kept: the same command goes on with the rest");
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
}

}  // namespace flexneck::pipeline
