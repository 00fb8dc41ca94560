// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/parameter_studies/sampling/row_file.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fcntl.h>
#include <span>
#include <sys/types.h>
#include <unistd.h>
#include <utility>

#include "geometry/foundation/content_hash.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/input_file.h"
#include "geometry/foundation/output_file.h"
#include "geometry/foundation/printable.h"

namespace flexneck::pipeline {

bool FilesNow::is_same(const FileRead& file) {
  if (is_unknown_here(file.hash)) return true;
  const auto [known, is_new] = hashes_.try_emplace(file.path);
  if (is_new) known->second = hash_now(file.path);
  return known->second == file.hash;
}

std::vector<FileRead> FilesNow::files() const {
  std::vector<FileRead> files;
  files.reserve(hashes_.size());
  for (const auto& [path, hash] : hashes_) files.push_back({path, hash});
  return files;
}

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kHashDigits = 16;

fs::path curves_beside(const fs::path& path) { return path.string() + ".curves"; }

constexpr std::string_view kFiles = "files";

std::string heading(const RowFormat& format) { return "flexneck rows 2," + format.definition; }

/// Line "files", followed for each file by a tab, its hash, a blank and its path. A path with
/// characters that must be spelt out cannot be found again: its rows are computed again.
std::string line_of(const std::vector<FileRead>& files) {
  std::string line(kFiles);
  for (const FileRead& file : files) line += '\t' + file.hash + ' ' + printable(file.path);
  return line;
}

std::string bytes_of(const Eigen::VectorXd& curves) {
  std::string bytes(static_cast<std::size_t>(curves.size()) * sizeof(double), '\0');
  if (!bytes.empty()) std::memcpy(bytes.data(), curves.data(), bytes.size());
  return bytes;
}

std::string hash_of(const std::string& files, const std::string& line, const std::string& curves) {
  return hash_of_text(files + '\n' + line + '\n' + curves).substr(0, kHashDigits);
}

/// Removes a number and the comma after it from a text.
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

WholeLines::WholeLines(fs::path path) : path_(std::move(path)) {
  std::error_code none;
  if (fs::exists(path_, none)) file_ = open_to_read(path_);
}

bool WholeLines::next(std::string& line) {
  constexpr std::size_t kBlock = 1 << 16;
  if (!file_) return false;
  for (;;) {
    const std::size_t end = block_.find('\n', at_);
    if (end != std::string::npos) {
      line = block_.substr(at_, end - at_);
      at_ = end + 1;
      end_ += line.size() + 1;
      return true;
    }
    block_.erase(0, std::exchange(at_, 0));
    const std::size_t kept = block_.size();
    block_.resize(kept + kBlock);
    const std::size_t count = read_at(file_, place_, std::span(block_).subspan(kept), path_);
    block_.resize(kept + count);
    place_ += count;
    if (count == 0) return false;
  }
}

RowReader::RowReader(const fs::path& path, RowFormat format)
    : format_(std::move(format)), curves_path_(curves_beside(path)), lines_(path) {
  std::string first;
  is_at_end_ = !lines_.next(first);
  if (is_at_end_) return;
  is_of_another_ = is_at_end_ = first != heading(format_);
  if (is_of_another_) return;
  end_ = lines_.end();
  std::error_code none;
  if (format_.curve_values > 0 && fs::exists(curves_path_, none))
    curves_ = open_to_read(curves_path_);
}

bool RowReader::are_as_read(std::string_view line) {
  line.remove_prefix(kFiles.size());
  while (!line.empty()) {
    line.remove_prefix(1);  // the tab
    const std::string_view file = line.substr(0, line.find('\t'));
    line.remove_prefix(file.size());
    const std::size_t blank = std::min(file.find(' '), file.size() - 1);
    const FileRead read{std::string(file.substr(blank + 1)), std::string(file.substr(0, blank))};
    if (format_.files->is_same(read)) continue;
    changed_ = read.path;
    if (is_unknown(read))
      changed_ +=
          " (the files that the script reads are unknown, so that its rows are valid for one "
          "process only; run without --shard)";
    return false;
  }
  return true;
}

bool RowReader::next(RowResult& result) {
  std::string line;
  const auto stop = [&] {
    is_at_end_ = true;
    return false;
  };
  for (;;) {
    if (is_at_end_ || !lines_.next(line)) return false;
    if (!line.starts_with(kFiles)) break;
    files_ = line;
    if (!are_as_read(files_)) return stop();
  }
  if (line.size() < kHashDigits + 1) return stop();
  const std::string text = line.substr(0, line.size() - kHashDigits - 1);
  if (!parse(text, format_.figures, result)) return stop();
  result.curves.resize(format_.curve_values);
  std::string bytes(static_cast<std::size_t>(format_.curve_values) * sizeof(double), '\0');
  if (!bytes.empty() &&
      (!curves_ || read_at(curves_, end_of_curves_, bytes, curves_path_) < bytes.size()))
    return stop();
  if (line.substr(text.size()) != "|" + hash_of(files_, text, bytes)) return stop();
  if (!bytes.empty()) std::memcpy(result.curves.data(), bytes.data(), bytes.size());
  end_ = lines_.end();
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
  const std::string files = line_of(result.reads);
  // The curves are written first, since a row exists once its line does.
  if (curves_) write(curves_, curves);
  const std::string before = files == files_ ? "" : files + "\n";
  write(lines_, before + line + "|" + hash_of(files, line, curves) + "\n");
  files_ = files;
}

void RowWriter::write(const FileDescriptor& file, std::string_view bytes) const {
  while (!bytes.empty()) {
    const ssize_t count =
        uninterrupted([&] { return ::write(file.get(), bytes.data(), bytes.size()); });
    if (count <= 0)
      throw ComputationError(path_.string() + ": cannot be written (" + std::strerror(errno) +
                             "); completed rows are kept; run the same command again to continue");
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
}

}  // namespace flexneck::pipeline
