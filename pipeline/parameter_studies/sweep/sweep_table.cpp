// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/parameter_studies/sweep/sweep_table.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>
#include <utility>

#include "geometry/foundation/output_file.h"
#include "pipeline/parameter_studies/sweep/bootstrap.h"

namespace flexneck::pipeline {

namespace fs = std::filesystem;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Text as a cell of CSV: in quotes if needed.
std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string result = "\"";
  for (const char letter : text) result += letter == '"' ? "\"\"" : std::string(1, letter);
  return result + "\"";
}

std::string heading(const std::string& name, const std::string& unit) {
  return quoted(unit == "1" ? name : name + " [" + unit + "]");
}

std::string head_line(const SweepRows& sweep, const std::vector<OutputColumn>& outputs) {
  std::string line = "row";
  const std::vector<SweepParameter>& parameters = sweep.section().parameters;
  for (std::size_t k = 0; k < parameters.size(); ++k)
    line += "," + heading(parameters[k].name, sweep.units()[k]);
  for (const OutputColumn& each : outputs) line += "," + heading(each.name, each.unit);
  return line + ",problem\n";
}

std::string text_line(const SweepRows& sweep, const VectorXd& inputs, const RowResult& result) {
  std::string line = std::to_string(result.row);
  const std::vector<SweepParameter>& parameters = sweep.section().parameters;
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    const double value = inputs[static_cast<Index>(k)];
    line += "," + (parameters[k].texts.empty()
                       ? exact_text(value)
                       : quoted(parameters[k].texts[static_cast<std::size_t>(value)]));
  }
  for (const double figure : result.figures) line += "," + exact_text(figure);
  return line + "," + quoted(result.problem) + "\n";
}

/// Columns of numbers that are written to the file block by block.
class Columns {
 public:
  Columns(Hdf5Writer& file, std::string group, std::vector<OutputColumn> names)
      : file_(file), group_(std::move(group)), names_(std::move(names)), waiting_(names_.size()) {}

  void append(const VectorXd& values) {
    for (std::size_t k = 0; k < waiting_.size(); ++k)
      waiting_[k].push_back(values[static_cast<Index>(k)]);
    if (!waiting_.empty() && waiting_.front().size() >= kBlock) flush();
  }

  void flush() {
    for (std::size_t k = 0; k < waiting_.size(); ++k) {
      file_.append(group_ + names_[k].name, waiting_[k], {}, names_[k].unit);
      waiting_[k].clear();
    }
  }

 private:
  static constexpr std::size_t kBlock = 4096;

  Hdf5Writer& file_;
  std::string group_;
  std::vector<OutputColumn> names_;
  std::vector<std::vector<double>> waiting_;
};

std::vector<OutputColumn> input_columns(const SweepRows& sweep) {
  std::vector<OutputColumn> columns;
  for (std::size_t k = 0; k < sweep.units().size(); ++k)
    columns.push_back({sweep.section().parameters[k].name, sweep.units()[k]});
  return columns;
}

void write_texts(Hdf5Writer& file, const SweepRows& sweep) {
  for (const SweepParameter& each : sweep.section().parameters)
    if (!each.texts.empty()) file.write("/texts/" + each.name, each.texts);
}

/// Rows that failed, with the reasons.
struct Failures {
  std::vector<double> rows;
  std::vector<std::string> problems;
};

void note_failure(const RowResult& result, SweepTable& table, Failures& failures) {
  if (!result.has_failed()) return;
  ++table.failed;
  failures.rows.push_back(static_cast<double>(result.row));
  failures.problems.push_back(result.problem);
  if (table.reasons.size() < SweepTable::kMaxReasons || table.reasons.contains(result.problem))
    ++table.reasons[result.problem];
}

}  // namespace

SweepTable write_sweep_table(const fs::path& csv, const fs::path& hdf5, const SweepRows& sweep,
                             const std::vector<OutputColumn>& outputs, MergedRows& rows,
                             const Provenance& provenance) {
  SweepTable table;
  table.figures.resize(static_cast<Index>(outputs.size()), static_cast<Index>(sweep.count()));
  OutputFile text(csv);
  Hdf5Writer file(hdf5, kSweepFormat);
  Columns inputs(file, "/inputs/", input_columns(sweep));
  Columns figures(file, "/outputs/", outputs);
  Failures failures;
  text.write(head_line(sweep, outputs));
  std::uint64_t expected = 0;
  for (RowResult result; rows.next(result);) {
    if (result.row != expected++) throw std::logic_error("a row of the sweep is missing");
    const VectorXd numbers = sweep.numbers(result.row);
    text.write(text_line(sweep, numbers, result));
    inputs.append(numbers);
    figures.append(result.figures);
    table.figures.col(static_cast<Index>(result.row)) = result.figures;
    note_failure(result, table, failures);
  }
  if (expected != sweep.count()) throw std::logic_error("the last rows of the sweep are missing");
  inputs.flush();
  figures.flush();
  write_texts(file, sweep);
  if (!failures.rows.empty()) {
    file.write("/failed/rows", failures.rows, {failures.rows.size()}, "1");
    file.write("/failed/problems", failures.problems);
  }
  write_provenance(file, provenance);
  file.commit();
  text.commit();
  return table;
}

std::vector<MatrixXd> percentile_bands(const std::vector<CurveColumn>& curves,
                                       const std::function<MergedRows()>& rows,
                                       std::uint64_t row_count) {
  Index total = 0;
  for (const CurveColumn& each : curves) total += each.time_s.size();
  constexpr double kMaxNumbers = 8e6;  // numbers in memory, 64 MB at a time
  const auto block = std::max<Index>(
      1,
      static_cast<Index>(kMaxNumbers / static_cast<double>(std::max<std::uint64_t>(1, row_count))));
  MatrixXd all(static_cast<Index>(std::size(kBandShares)), total);
  for (Index start = 0; start < total; start += block) {
    const Index count = std::min(block, total - start);
    std::vector<std::vector<double>> values(static_cast<std::size_t>(count));
    MergedRows reading = rows();
    for (RowResult row; reading.next(row);)
      for (Index k = 0; k < count; ++k)
        if (!std::isnan(row.curves[start + k]))
          values[static_cast<std::size_t>(k)].push_back(row.curves[start + k]);
    for (Index k = 0; k < count; ++k) {
      std::vector<double>& column = values[static_cast<std::size_t>(k)];
      std::sort(column.begin(), column.end());
      const VectorXd sorted = VectorXd::Map(column.data(), static_cast<Index>(column.size()));
      for (std::size_t s = 0; s < std::size(kBandShares); ++s)
        all(static_cast<Index>(s), start + k) =
            column.empty() ? std::nan("") : sorted_quantile(sorted, kBandShares[s]);
    }
  }
  std::vector<MatrixXd> bands;
  Index start = 0;
  for (const CurveColumn& each : curves) {
    bands.emplace_back(all.middleCols(start, each.time_s.size()));
    start += each.time_s.size();
  }
  return bands;
}

}  // namespace flexneck::pipeline
