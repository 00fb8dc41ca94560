// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/numerics/piecewise_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/foundation/available_memory.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/output_file.h"

namespace flexneck::multibody {
namespace {

/// Fraction of the function's largest value that the last coefficients of a piece may reach, and
/// the multiple of that and of rounding by which a sample may deviate.
constexpr double kResolution = 1e-13;
constexpr double kSampleMargin = 10;
/// Number of roundings of the time by which a sample may deviate: a piece changes by its range,
/// with slopes of up to a few times range over length.
constexpr double kRoundings = 8;
/// Limits of a fit: a piece takes 0.5 kB.
constexpr double kMaxSamples = 1e8;
constexpr std::size_t kMaxPieces = 1'000'000;
constexpr std::size_t kMaxBreaks = 100'000;
/// Number of breaks within the resolution that are not separate kinks.
constexpr std::size_t kCluster = 20;
constexpr double kMinSamples = 64;
/// Growth of the rounding of a series in its derivatives, by about the square of the number of
/// terms and by two over the length: here with all terms, and length one.
constexpr double kFirstGrowth = 1e3;
constexpr double kSecondGrowth = 1e5;
/// Ratio of a coefficient to the largest sample above which the function has a pole. The
/// coefficients of a jump are smaller.
constexpr double kUnbounded = 100;
/// Ratio of lengths: an unresolved piece between resolved pieces of so many times its length
/// contains a single kink or jump.
constexpr double kIsolation = 256;

double at(const PiecewiseFit::Piece& piece, const ChebyshevSeries& series, double time_s) {
  return sum_of(series, (2 * time_s - piece.begin_s - piece.end_s) / piece.length_s());
}

ChebyshevSeries derivative_of(const PiecewiseFit::Piece& piece, int order) {
  ChebyshevSeries series = piece.series;
  for (int k = 0; k < order; ++k) series = derivative(series, piece.length_s());
  return series;
}

}  // namespace

void refuse_motion(double time_s, const std::string& problem) {
  throw InputError("the motion " + problem + " at " + rounded_text(time_s) + " s");
}

PiecewiseFit::PiecewiseFit(const Function& f, double end_s, const Sampling& sampling)
    : f_(f),
      resolution_s_(sampling.resolution_s),
      rounding_s_(std::numeric_limits<double>::epsilon() * end_s) {
  constexpr double kShortest_s = 1e-8;
  constexpr double kShortestInRoundings = 1e5;
  shortest_s_ = std::max(kShortest_s, kShortestInRoundings * rounding_s_);
  if (!(2 * end_s / resolution_s_ < kMaxSamples))
    throw InputError("its resolution, " + exact_text(resolution_s_) +
                     " s, gives over 1e8 samples over " + exact_text(end_s) +
                     " s; increase solver.resolution");
  for (const double time_s : sampling.breakpoints_s) {
    if (!(time_s > 0 && time_s < end_s)) continue;
    if (!breaks_.empty() && !(time_s > breaks_.back()))
      throw InputError("its breakpoints must increase, but " + exact_text(time_s) +
                       " s is not after " + exact_text(breaks_.back()) + " s");
    breaks_.push_back(time_s);
  }
  std::vector<double> ends = breaks_;
  ends.push_back(end_s);
  std::vector<Grid> grids;
  for (double begin = 0; const double end : ends) {
    grids.push_back(sampled(begin, end));
    begin = end;
  }
  for (const Grid& grid : grids) cover_stretch(grid, grid.begin_s, grid.end_s);
  find_hidden_breaks();
}

double PiecewiseFit::value(double time_s) const {
  const double value = f_(time_s);
  if (!std::isfinite(value)) refuse_motion(time_s, "is not a finite number");
  return value;
}

/// Samples the function, at least twice in each feature of the resolution and once away from its
/// foot, to determine how large it is.
PiecewiseFit::Grid PiecewiseFit::sampled(double begin_s, double end_s) {
  const double length_s = end_s - begin_s;
  const double count = std::max(kMinSamples, std::ceil(2 * length_s / resolution_s_)) + 1;
  require_memory("a motion sampled at its resolution", count * sizeof(double),
                 "increase solver.resolution");
  Grid grid{begin_s, end_s, length_s / count, {}};
  std::vector<double>& f = grid.values;
  f.reserve(static_cast<std::size_t>(count) + 1);
  for (std::size_t k = 0; k <= static_cast<std::size_t>(count); ++k) {
    f.push_back(value(std::min(grid.time_s(k), end_s)));
    scale_ = std::max(scale_, std::abs(f[k]));
    if (k > 1)
      curvature_ = std::max(curvature_,
                            std::abs(f[k] - 2 * f[k - 1] + f[k - 2]) / (grid.step_s * grid.step_s));
  }
  return grid;
}

/// Covers an interval without known breaks. It starts anew whenever a break is found, so that the
/// pieces before the break end exactly there.
void PiecewiseFit::cover_stretch(const Grid& grid, double begin_s, double end_s) {
  std::size_t before = pieces_.size();
  while (const std::optional<double> found = cover(grid, begin_s, begin_s, end_s)) {
    pieces_.resize(before);
    if (!(*found > begin_s && *found < end_s))
      refuse_motion(*found, "is not piecewise smooth, e.g.");
    add_break(*found);
    cover_stretch(grid, begin_s, *found);
    begin_s = *found;
    before = pieces_.size();
  }
}

void PiecewiseFit::add_break(double time_s) {
  breaks_.push_back(time_s);
  if (breaks_.size() > kCluster) {
    const auto close = std::count_if(breaks_.end() - kCluster, breaks_.end(), [&](double other) {
      return std::abs(other - time_s) < resolution_s_;
    });
    if (close == kCluster) refuse_motion(time_s, "is not piecewise smooth, e.g.");
  }
  if (breaks_.size() > kMaxBreaks)
    refuse_motion(time_s, "has more than 100000 jumps and kinks, the last");
}

void PiecewiseFit::add(const Piece& piece) {
  pieces_.push_back(piece);
  if (pieces_.size() > kMaxPieces)
    refuse_motion(
        piece.end_s,
        "changes too fast to be represented over the run: a million polynomial pieces end");
}

/// Returns the first break inside, or adds pieces up to the end.
std::optional<double> PiecewiseFit::cover(const Grid& grid, double stretch_s, double begin_s,
                                          double end_s) {
  const Piece whole = piece(begin_s, end_s);
  if (is_resolved(whole) && follows(grid, whole)) {
    add(whole);
    return {};
  }
  if (end_s - begin_s < shortest_s_) {
    const bool is_near_break =
        begin_s < stretch_s + 2 * shortest_s_ ||
        std::any_of(breaks_.begin(), breaks_.end(), [&](double time_s) {
          return time_s > begin_s - 2 * shortest_s_ && time_s < end_s + 2 * shortest_s_;
        });
    if (!is_near_break) return locate(begin_s, end_s);
    double size = 0;
    for (const double term : whole.series) size += std::abs(term);
    if (size > kUnbounded * scale_) refuse_motion(begin_s, "is not piecewise smooth, e.g.");
    add(whole);
    return {};
  }
  if (const auto found = isolated_break(grid, stretch_s, begin_s, end_s)) return found;
  const double middle = 0.5 * (begin_s + end_s);
  if (const auto found = cover(grid, stretch_s, begin_s, middle)) return found;
  return cover(grid, stretch_s, middle, end_s);
}

/// The time, to rounding, at which the function leaves its continuation from the left, if it is
/// smooth on both sides of a short interval; also if only a higher derivative jumps.
std::optional<double> PiecewiseFit::isolated_break(const Grid& grid, double stretch_s,
                                                   double begin_s, double end_s) const {
  double next_break = grid.end_s;
  for (const double time_s : breaks_)
    if (time_s >= end_s) next_break = std::min(next_break, time_s);
  const double around_s = kIsolation * (end_s - begin_s);
  if (begin_s - around_s < stretch_s || end_s + around_s > next_break) return {};
  const Piece left = piece(begin_s - around_s, begin_s);
  if (!is_resolved(left) || !is_resolved(piece(end_s, end_s + around_s))) return {};
  const double margin = kSampleMargin * tolerance(left);
  const auto goes_on = [&](double time_s) {
    return std::abs(f_(time_s) - at(left, left.series, time_s)) <= margin;
  };
  if (goes_on(end_s)) return {};
  double before = begin_s;
  double behind = end_s;
  while (true) {
    const double middle = 0.5 * (before + behind);
    if (!(middle > before && middle < behind)) return behind;
    (goes_on(middle) ? before : behind) = middle;
  }
}

/// The time of a jump inside a short interval, to rounding; any time inside for a kink.
double PiecewiseFit::locate(double begin_s, double end_s) const {
  while (true) {
    const double middle = 0.5 * (begin_s + end_s);
    if (!(middle > begin_s && middle < end_s)) return end_s;
    const double at_middle = f_(middle);
    if (std::abs(at_middle - f_(begin_s)) > std::abs(f_(end_s) - at_middle))
      end_s = middle;
    else
      begin_s = middle;
  }
}

PiecewiseFit::Piece PiecewiseFit::piece(double begin_s, double end_s) const {
  return {begin_s, end_s,
          interpolated([&](double time_s) { return value(time_s); }, begin_s, end_s)};
}

double PiecewiseFit::tolerance(const Piece& piece) const {
  double range = 0;
  for (std::size_t k = 1; k < kChebyshevTerms; ++k) range += 2 * std::abs(piece.series[k]);
  return kResolution * scale_ + kRoundings * rounding_s_ * range / piece.length_s();
}

bool PiecewiseFit::is_resolved(const Piece& piece) const {
  const double least = tolerance(piece);
  return std::all_of(piece.series.begin() + kChebyshevTerms - 3,
                     piece.series.begin() + kChebyshevTerms,
                     [&](double term) { return std::abs(term) <= least; });
}

bool PiecewiseFit::follows(const Grid& grid, const Piece& piece) const {
  const double margin = kSampleMargin * tolerance(piece);
  const auto differs = [&](double time_s, double value) {
    return !(std::abs(value - at(piece, piece.series, time_s)) <= margin);
  };
  // A kink may lie closer to the ends than any node.
  for (const double time_s :
       {std::nextafter(piece.begin_s, piece.end_s), std::nextafter(piece.end_s, piece.begin_s)})
    if (differs(time_s, value(time_s))) return false;
  const double first = std::floor((piece.begin_s - grid.begin_s) / grid.step_s);
  for (auto k = static_cast<std::size_t>(std::max(first, 0.0)); k < grid.values.size(); ++k) {
    const double time_s = grid.time_s(k);
    if (!(time_s < piece.end_s)) break;
    if (time_s > piece.begin_s && differs(time_s, grid.values[k])) return false;
  }
  return true;
}

bool PiecewiseFit::jumps(std::size_t k, int order) const {
  const Piece& before = pieces_[k];
  const Piece& behind = pieces_[k + 1];
  const double jump =
      std::abs(sum_of(derivative_of(behind, order), -1) - sum_of(derivative_of(before, order), 1));
  const double shortest_s = std::min(before.length_s(), behind.length_s());
  const double rounding = std::max(tolerance(before), tolerance(behind));
  // A break is found only once the value has left its continuation by the margin of samples.
  if (order == 0) return jump > 1e-9 * scale_ + 2 * kSampleMargin * rounding;
  if (order == 2)
    return jump > 1e-6 * curvature_ + kSecondGrowth * rounding / (shortest_s * shortest_s);
  // A break of the second derivative is found only once it has changed the value beyond rounding.
  return jump > 1e-6 * steepest_ + kFirstGrowth * rounding / shortest_s +
                    20 * std::sqrt(2 * kSampleMargin * rounding * curvature_);
}

bool PiecewiseFit::loses(std::size_t k, int order) const {
  const double length_s = pieces_[k].length_s();
  const double change = curvature_ * length_s * length_s;
  return (order == 1 ? kFirstGrowth : kSecondGrowth) * tolerance(pieces_[k]) > change;
}

/// Adds breaks at which halving has ended a piece by chance, so that the pieces on both sides are
/// resolved.
void PiecewiseFit::find_hidden_breaks() {
  std::sort(breaks_.begin(), breaks_.end());
  for (const Piece& piece : pieces_)
    for (const double x : {-1.0, 0.0, 1.0})
      steepest_ = std::max(steepest_, std::abs(sum_of(derivative_of(piece, 1), x)));
  std::vector<double> found;
  for (std::size_t k = 0; k + 1 < pieces_.size(); ++k)
    if (jumps(k, 0) || jumps(k, 1) || jumps(k, 2)) found.push_back(pieces_[k].end_s);
  breaks_.insert(breaks_.end(), found.begin(), found.end());
  std::sort(breaks_.begin(), breaks_.end());
  breaks_.erase(std::unique(breaks_.begin(), breaks_.end()), breaks_.end());
}

}  // namespace flexneck::multibody
