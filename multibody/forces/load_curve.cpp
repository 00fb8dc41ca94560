// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/forces/load_curve.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "geometry/foundation/error.h"
#include "geometry/foundation/output_file.h"

namespace flexneck::multibody {

LoadCurve LoadCurve::cubic(double c1, double c2, double c3) {
  if (!(std::isfinite(c1) && std::isfinite(c2) && std::isfinite(c3)))
    throw InputError("load curve: its coefficients must be finite");
  LoadCurve curve;
  curve.c1_ = c1;
  curve.c2_ = c2;
  curve.c3_ = c3;
  return curve;
}

LoadCurve LoadCurve::locking(double c, double L) {
  if (!(c >= 0 && L > 0 && std::isfinite(c) && std::isfinite(L)))
    throw InputError(
        "load curve: a curve that locks needs a non-negative stiffness and a positive deflection "
        "at which it locks");
  LoadCurve curve;
  curve.c1_ = c;
  curve.L_ = L;
  return curve;
}

LoadCurve LoadCurve::table(std::vector<double> x, std::vector<double> load) {
  if (x.size() != load.size() || x.size() < 2)
    throw InputError("load curve: expected a load for each of at least two deflections, found " +
                     std::to_string(x.size()) + " deflections and " + std::to_string(load.size()) +
                     " loads");
  for (std::size_t k = 0; k < x.size(); ++k) {
    if (!std::isfinite(x[k]) || !std::isfinite(load[k]))
      throw InputError("load curve: row " + std::to_string(k + 1) + " is not finite");
    if (k > 0 && !(x[k] > x[k - 1]))
      throw InputError("load curve: deflections must increase strictly, but row " +
                       std::to_string(k + 1) + " has " + exact_text(x[k]) + " after " +
                       exact_text(x[k - 1]));
  }
  if (x[0] != 0 || load[0] != 0)
    throw InputError("load curve: the first row must be 0, 0, but is " + exact_text(x[0]) + ", " +
                     exact_text(load[0]));
  LoadCurve curve;
  curve.energy_.assign(x.size(), 0);
  for (std::size_t k = 1; k < x.size(); ++k)
    curve.energy_[k] = curve.energy_[k - 1] + (x[k] - x[k - 1]) * (load[k] + load[k - 1]) / 2;
  curve.x_ = std::move(x);
  curve.load_ = std::move(load);
  return curve;
}

namespace {

/// The row at which the piece at x starts; the first and the last piece are extrapolated.
std::size_t row_before(const std::vector<double>& rows, double x) {
  const auto after = std::upper_bound(rows.begin() + 1, rows.end() - 1, x);
  return static_cast<std::size_t>(after - rows.begin()) - 1;
}

/// Fraction of the locking deflection up to which a curve follows its law.
constexpr double kLocked = 0.9;

}  // namespace

CurvePiece LoadCurve::piece(double x) const {
  CurvePiece found;
  if (locks()) {
    found.number = x < kLocked * L_ ? 0 : 1;
    (found.number == 0 ? found.high : found.low) = kLocked * L_;
  } else if (!x_.empty()) {
    const std::size_t row = row_before(x_, x);
    found.number = static_cast<int>(row);
    found.low = x_[row];
    if (row + 2 < x_.size()) found.high = x_[row + 1];
  }
  return found;
}

bool LoadCurve::continues(const LoadCurve& other) const {
  if (locks() || other.locks()) return c1_ == other.c1_ && L_ == other.L_;
  if (x_.empty() != other.x_.empty()) return false;
  if (x_.empty()) return c1_ == other.c1_ && c2_ == 0 && other.c2_ == 0 && c3_ == other.c3_;
  return load_[1] * other.x_[1] == other.load_[1] * x_[1];
}

bool LoadCurve::falls() const {
  if (locks()) return false;
  if (!x_.empty()) return !std::is_sorted(load_.begin(), load_.end());
  // The slope c1 + 2 c2 x + 3 c3 x^2 is least at -c2 / (3 c3), if that is positive, or at an end.
  if (c1_ < 0 || c3_ < 0 || (c3_ == 0 && c2_ < 0)) return true;
  return c2_ < 0 && c1_ < c2_ * c2_ / (3 * c3_);
}

double LoadCurve::value(double x) const {
  if (locks()) {
    const double of_law = std::min(x, kLocked * L_);
    const double left = 1 - of_law / L_;
    return c1_ * of_law / left + c1_ / (left * left) * (x - of_law);
  }
  if (x_.empty()) return x * (c1_ + x * (c2_ + x * c3_));
  const std::size_t k = row_before(x_, x);
  const double slope = (load_[k + 1] - load_[k]) / (x_[k + 1] - x_[k]);
  return load_[k] + slope * (x - x_[k]);
}

double LoadCurve::energy(double x) const {
  if (locks()) {
    const double share = std::min(x / L_, kLocked);
    const double of_law = -c1_ * L_ * L_ * (share + std::log1p(-share));
    return of_law + (x - share * L_) * (value(share * L_) + value(x)) / 2;
  }
  if (x_.empty()) return x * x * (c1_ / 2 + x * (c2_ / 3 + x * c3_ / 4));
  const std::size_t k = row_before(x_, x);
  return energy_[k] + (x - x_[k]) * (load_[k] + value(x)) / 2;
}

}  // namespace flexneck::multibody
