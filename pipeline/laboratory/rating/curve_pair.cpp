// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/laboratory/rating/curve_pair.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "geometry/foundation/error.h"
#include "geometry/foundation/output_file.h"

namespace flexneck::pipeline {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// Correlations that differ by rounding only. Without this a periodic curve compared with itself
/// could be found a period late.
constexpr double kSameCorrelation = 1e-12;
/// Rounding error of the variation where part of a curve is constant, relative to its mean square.
constexpr double kNoVariation = 1e-12;

void check_varies(const VectorXd& curve, const std::string& name) {
  if (!curve.allFinite())
    throw InputError("the " + name + " curve has a value that is not finite; remove it");
  const double spread = curve.maxCoeff() - curve.minCoeff();
  if (!(spread > 0))
    throw InputError("the " + name + " curve is constant (" + rounded_text(curve[0]) +
                     "), so that no correlation is defined; expected a varying curve");
}

/// Sums over the first k samples, k = 0 … n, of a curve and of its squares.
struct RunningSums {
  explicit RunningSums(const VectorXd& curve)
      : values(VectorXd::Zero(curve.size() + 1)), squares(VectorXd::Zero(curve.size() + 1)) {
    for (Index k = 0; k < curve.size(); ++k) {
      values[k + 1] = values[k] + curve[k];
      squares[k + 1] = squares[k] + curve[k] * curve[k];
    }
  }
  VectorXd values, squares;
};

/// A curve about its mean or about zero, with its sums.
class CorrelatedCurve {
 public:
  CorrelatedCurve(const VectorXd& curve, Correlation kind)
      : is_centred_(kind == Correlation::about_mean),
        values_(is_centred_ ? VectorXd(curve.array() - curve.mean()) : curve),
        sums_(values_) {}

  const VectorXd& values() const { return values_; }
  /// Sum over a part of the curve, which the means subtract from the sum of products; 0 about zero.
  double sum(Index first, Index count) const {
    return is_centred_ ? sums_.values[first + count] - sums_.values[first] : 0;
  }
  /// Sum of the squares about the mean of the part, or about zero; 0 if only rounding remains.
  double energy(Index first, Index count) const {
    const double part = sum(first, count);
    const double energy = sums_.squares[first + count] - sums_.squares[first] -
                          part * part / static_cast<double>(count);
    return energy > kNoVariation * sums_.squares[values_.size()] ? energy : 0;
  }

 private:
  bool is_centred_;
  VectorXd values_;
  RunningSums sums_;
};

/// Correlation of the overlap; NaN if a part does not vary.
double correlation(const CorrelatedCurve& reference, const CorrelatedCurve& computed, Index shift) {
  const Index count = reference.values().size() - std::abs(shift);
  const Index first = std::max<Index>(-shift, 0);  // index in the reference
  const Index other = std::max<Index>(shift, 0);
  const double scale = std::sqrt(reference.energy(first, count) * computed.energy(other, count));
  const double product =
      reference.values().segment(first, count).dot(computed.values().segment(other, count)) -
      reference.sum(first, count) * computed.sum(other, count) / static_cast<double>(count);
  return scale > 0 ? product / scale : std::nan("");
}

}  // namespace

void check_rated(const VectorXd& reference, const VectorXd& computed) {
  if (reference.size() != computed.size())
    throw InputError("expected curves of equal length, found " + std::to_string(reference.size()) +
                     " and " + std::to_string(computed.size()) + " samples");
  const auto must_have = [&](const char* bound, Index count) {
    throw InputError("expected " + std::string(bound) + " " + std::to_string(count) +
                     " samples for a rating, found " + std::to_string(reference.size()) +
                     "; choose another interval");
  };
  if (reference.size() < kMinRatedSamples) must_have("at least", kMinRatedSamples);
  if (reference.size() > kMaxRatedSamples) must_have("at most", kMaxRatedSamples);
  check_varies(reference, "reference");
  check_varies(computed, "computed");
}

Overlap overlap(const VectorXd& reference, const VectorXd& computed, Index shift) {
  const Index count = reference.size() - std::abs(shift);
  return {reference.segment(std::max<Index>(-shift, 0), count),
          computed.segment(std::max<Index>(shift, 0), count)};
}

BestShift best_shift(const VectorXd& reference, const VectorXd& computed, Index max_shift,
                     Correlation kind) {
  // Scaled, so that no square overflows or vanishes.
  const CorrelatedCurve first(reference / reference.lpNorm<Eigen::Infinity>(), kind);
  const CorrelatedCurve second(computed / computed.lpNorm<Eigen::Infinity>(), kind);
  BestShift best;
  bool is_found = false;
  const auto consider = [&](Index shift) {
    const double found = correlation(first, second, shift);
    if (std::isnan(found) || (is_found && !(found > best.correlation + kSameCorrelation))) return;
    best = {shift, found};
    is_found = true;
  };
  consider(0);
  for (Index shift = 1; shift <= max_shift; ++shift) {
    consider(shift);
    consider(-shift);
  }
  return best;
}

Index samples_within(double share, Index n) {
  return static_cast<Index>(std::floor(share * static_cast<double>(n) + 1e-9));
}

double corridor_rating(const VectorXd& reference, const VectorXd& computed, double inner,
                       double outer, double exponent) {
  const double norm = reference.lpNorm<Eigen::Infinity>();
  const VectorXd distance = (computed / norm - reference / norm).cwiseAbs();
  const Eigen::ArrayXd place = (outer - distance.array()) / (outer - inner);
  return place.max(0).min(1).pow(exponent).mean();
}

}  // namespace flexneck::pipeline
