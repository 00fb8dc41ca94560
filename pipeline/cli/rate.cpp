// SPDX-License-Identifier: GPL-3.0-or-later
#include <utility>

#include <fmt/core.h>

#include "geometry/foundation/content_hash.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/units.h"
#include "pipeline/cli/commands.h"
#include "pipeline/laboratory/rating/cora.h"
#include "pipeline/laboratory/rating/iso18571.h"
#include "pipeline/laboratory/rating/resampling.h"
#include "pipeline/process/result_table.h"

namespace flexneck::pipeline {

namespace fs = std::filesystem;

namespace {

std::optional<double> time_of(const std::string& option, const std::string& text) {
  if (text.empty()) return {};
  try {
    return parse_quantity(text, "s");
  } catch (const InputError& error) {
    throw InputError(option + ": " + error.what());
  }
}

/// The reference and the computed curve, the latter converted to the unit of the reference.
struct CurvesOfOneUnit {
  Curve reference, computed;
};

CurvesOfOneUnit read_curves(const FileInput& input) {
  const CurveChoice& choice = input.curves;
  CurvesOfOneUnit curves = {
      read_curve(input.files[0],
                 choice.reference_channel.empty() ? choice.channel : choice.reference_channel),
      read_curve(input.files[1], choice.channel)};
  const bool is_needed = curves.reference.unit.empty() || curves.computed.unit.empty();
  if (!choice.unit.empty() && !is_needed)
    throw InputError("--unit: both files give the units of their values; remove this option");
  for (Curve* curve : {&curves.reference, &curves.computed})
    if (curve->unit.empty()) curve->unit = choice.unit;
  if (curves.reference.unit.empty() != curves.computed.unit.empty()) {
    const bool lacks = curves.computed.unit.empty();
    throw InputError((lacks ? curves.computed : curves.reference).label() +
                     ": gives no unit of its values, but " +
                     (lacks ? curves.reference : curves.computed).label() +
                     " does; set it with --unit");
  }
  curves.computed = in_unit(std::move(curves.computed), curves.reference.unit);
  return curves;
}

/// Label of a curve without its path, so that a result does not depend on where it was made; with
/// the name of the folder if both files have the same name.
std::string label_in_table(Curve curve, const Curve& other) {
  const fs::path path = fs::weakly_canonical(curve.file);
  const bool is_same = path.filename() == fs::path(other.file).filename();
  curve.file = ((is_same ? path.parent_path().filename() : fs::path()) / path.filename()).string();
  return curve.label();
}

std::string six_digits(double value) { return fmt::format("{:.6f}", value); }

/// Text such as "late by 0.7 ms, correlation 0.99977".
std::string shift_text(Eigen::Index shift, double interval_s, double correlation) {
  const double time_ms = 1e3 * interval_s * static_cast<double>(std::abs(shift));
  const std::string text =
      shift == 0 ? "no shift"
                 : fmt::format("{} by {:.1f} ms", shift > 0 ? "late" : "early", time_ms);
  return text + fmt::format(", correlation {:.6f}", correlation);
}

std::vector<ResultTable::Column> columns() {
  return {{"part", ""}, {"rating", ""}, {"weight", ""}, {"measured", ""}};
}

ResultTable iso_table(const ResampledPair& pair) {
  const Iso18571Rating rating = rate_iso18571(pair.reference, pair.computed);
  const std::string other = fmt::format("{:g}", kIso18571OtherWeight);
  return {"iso18571",
          fmt::format("ISO/TS 18571:2024, {:g} to {:g} s", pair.from_s, pair.to_s()),
          columns(),
          {{"corridor Z", six_digits(rating.corridor), fmt::format("{:g}", kIso18571CorridorWeight),
            ""},
           {"phase P", six_digits(rating.phase), other,
            shift_text(rating.shift, pair.interval_s, rating.correlation)},
           {"magnitude M", six_digits(rating.magnitude), other,
            fmt::format("error {:.6f}", rating.magnitude_error)},
           {"slope S", six_digits(rating.slope), other,
            fmt::format("error {:.6f}", rating.slope_error)},
           {"overall R", six_digits(rating.overall), "", ""}},
          {}};
}

/// Table of the CORA rating.
/// @param is_asked  whether the interval is the user's, not CORA's own
ResultTable cora_table(const ResampledPair& pair, bool is_asked) {
  const CoraParameters p;
  SampleRange range{0, pair.reference.size() - 1};
  if (!is_asked) range = cora_interval(pair.reference, p);
  const Eigen::Index count = range.last - range.first + 1;
  const CoraRating rating = rate_cora(pair.reference.segment(range.first, count),
                                      pair.computed.segment(range.first, count), p);
  const auto time = [&](Eigen::Index k) {
    return pair.from_s + pair.interval_s * static_cast<double>(k);
  };
  const auto weight = [](double value) { return fmt::format("{:g}", value); };
  return {
      "cora",
      fmt::format(
          "CORA 4.0.5, {:g} to {:g} s{}", time(range.first), time(range.last),
          is_asked ? "" : " (the interval of evaluation of CORA within the common interval)"),
      columns(),
      {{"corridor C1", six_digits(rating.corridor), weight(p.corridor_weight), ""},
       {"progression V", six_digits(rating.progression),
        weight(p.cross_correlation_weight * p.progression_weight),
        fmt::format("correlation about zero {:.6f}", rating.correlation)},
       {"size G", six_digits(rating.size), weight(p.cross_correlation_weight * p.size_weight),
        fmt::format("ratio of squares {:.6f}", rating.energy_ratio)},
       {"phase P", six_digits(rating.phase), weight(p.cross_correlation_weight * p.phase_weight),
        shift_text(rating.shift, pair.interval_s, rating.correlation)},
       {"cross-correlation C2", six_digits(rating.cross_correlation),
        weight(p.cross_correlation_weight), "of the three above"},
       {"overall C", six_digits(rating.overall), "", ""}},
      {}};
}

/// The input files, each prefixed by its role, since no name may occur twice.
std::vector<InputFile> inputs_of(const CurvesOfOneUnit& curves) {
  const auto file = [](const std::string& part, const Curve& curve) -> InputFile {
    return {part + "/" + curve.source.filename().string(), hash_of_file(curve.source.string())};
  };
  return {file("reference", curves.reference), file("computed", curves.computed)};
}

/// Text ", CFC 600 by its code" for a channel of ISO-MME.
std::string filter_text(const Curve& curve) {
  if (!curve.filter) return {};
  return ", " + std::string(curve.filter->text.empty() ? "unfiltered" : curve.filter->text) +
         " by its channel code";
}

/// Warns of different filters, since ratings compare the curves unfiltered.
void warn_of_filters(const FileInput& input, const CurvesOfOneUnit& curves) {
  const auto& reference = curves.reference.filter;
  const auto& computed = curves.computed.filter;
  if (reference && computed && reference->text != computed->text)
    input.console.warning("the channels were filtered differently: " + curves.reference.label() +
                          filter_text(curves.reference) + ", " + curves.computed.label() +
                          filter_text(curves.computed));
}

}  // namespace

bool rate_command(const FileInput& input) {
  if (input.files.size() != 2)
    throw InputError(
        "rate: expected two files, as in 'flexneck rate REFERENCE.csv COMPUTED.csv', found " +
        std::to_string(input.files.size()));
  const CurveChoice& choice = input.curves;
  const AskedInterval asked = {time_of("--from", choice.from), time_of("--to", choice.to)};
  const CurvesOfOneUnit curves = read_curves(input);
  warn_of_filters(input, curves);
  const ResampledPair pair = resampled(curves.reference, curves.computed, asked);
  std::vector<ResultTable> tables;
  try {
    tables = {iso_table(pair), cora_table(pair, asked.from_s || asked.to_s)};
  } catch (const InputError& error) {
    throw InputError(curves.computed.label() + ", against " + curves.reference.label() + ": " +
                     error.what());
  }
  tables.front().notes = {
      "reference  " + label_in_table(curves.reference, curves.computed) +
          filter_text(curves.reference),
      "computed   " + label_in_table(curves.computed, curves.reference) +
          filter_text(curves.computed),
      fmt::format(
          "{} samples at 10 kHz{}", pair.reference.size(),
          pair.is_interpolated ? ", interpolated linearly between those of the files" : "")};
  if (!input.folder.path().empty()) {
    input.folder.make();
    write_tables(input.folder.file("rating.json"), tables, provenance_of(inputs_of(curves), {}));
  }
  for (const ResultTable& table : tables) input.console.result(printed(table));
  return true;
}

}  // namespace flexneck::pipeline
