// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/results/tables/csv_output.h"

#include <utility>

#include <fmt/core.h>

#include "geometry/foundation/normal_number.h"

namespace flexneck::pipeline {

namespace {

/// Cell of a CSV file, in quotes if the text would be read as several cells.
std::string cell(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

std::string header_of(const std::string& first, const std::vector<multibody::Channel>& channels) {
  std::string line = first;
  for (const multibody::Channel& channel : channels)
    for (const std::string& column : channel.columns) {
      const bool is_one = channel.columns.size() == 1;
      line += "," + cell(channel.name + (is_one ? "" : " " + column) + " [" + channel.unit + "]");
    }
  return line;
}

}  // namespace

CsvWriter::CsvWriter(const std::filesystem::path& path, std::string first)
    : file_(path), first_(std::move(first)) {}

void CsvWriter::append(const Eigen::VectorXd& time_s,
                       const std::vector<multibody::Channel>& channels) {
  if (!first_.empty()) file_.write(header_of(std::exchange(first_, {}), channels) + "\n");
  for (Eigen::Index k = 0; k < time_s.size(); ++k) {
    std::string line = fmt::format("{}", time_s[k]);
    for (const multibody::Channel& channel : channels)
      for (const double value : channel.values.col(k))
        line += fmt::format(",{}", normal_number(value));
    file_.write(line + "\n");
  }
}

void write_csv(const std::filesystem::path& path, const Eigen::VectorXd& time_s,
               const std::vector<multibody::Channel>& channels, const std::string& first) {
  CsvWriter writer(path, first);
  writer.append(time_s, channels);
  writer.commit();
}

}  // namespace flexneck::pipeline
