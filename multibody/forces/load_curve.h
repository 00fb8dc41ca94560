// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <vector>

namespace flexneck::multibody {

/// A smooth piece of a curve, by its number, and the deflections at its ends.
struct CurvePiece {
  int number = 0;
  double low = 0;
  double high = std::numeric_limits<double>::infinity();
};

/// A load over a deflection x >= 0 starting at (0, 0), N or N m over m or rad: a cubic; a table
/// that is linear between its rows and continues beyond the last with the last slope; or a locking
/// curve. By default zero.
class LoadCurve {
 public:
  LoadCurve() = default;
  /// Curve c1 x + c2 x^2 + c3 x^3.
  /// @throws InputError if a coefficient is not finite.
  static LoadCurve cubic(double c1, double c2 = 0, double c3 = 0);
  /// @param x     from 0 on, strictly increasing, at least two rows
  /// @param load  the first is 0
  /// @throws InputError otherwise, or for values that are not finite.
  static LoadCurve table(std::vector<double> x, std::vector<double> load);
  /// Curve that is soft at first and stiff as x approaches L: c x / (1 - x / L) up to 0.9 L, then
  /// with the slope there, 100 c.
  /// @throws InputError unless c >= 0 and L > 0, both finite
  static LoadCurve locking(double c, double L);

  double value(double x) const;
  double energy(double x) const;  ///< integral of the load from 0 to x, J
  /// The piece at x: between two of the rows, or before or after locking; number 0 for a cubic.
  CurvePiece piece(double x) const;
  bool is_none() const { return c1_ == 0 && c2_ == 0 && c3_ == 0 && x_.empty(); }
  /// Slope at zero.
  double first_slope() const { return x_.empty() ? c1_ : load_[1] / x_[1]; }
  double last_row() const { return x_.empty() ? 0 : x_.back(); }  ///< deflection of the last row
  /// Returns whether the load decreases anywhere as the deflection grows.
  bool falls() const;
  /// Returns whether it and `other`, one for each direction, form one smooth curve through zero.
  bool continues(const LoadCurve& other) const;

  /// Serialises its fields (geometry/foundation/byte_archive.h).
  template <class Archive>
  void archive(Archive& all) {
    all(c1_, c2_, c3_, L_, x_, load_, energy_);
  }

 private:
  bool locks() const { return L_ > 0; }

  double c1_ = 0, c2_ = 0, c3_ = 0;
  double L_ = 0;  ///< deflection at which it would lock; zero if it does not
  std::vector<double> x_, load_, energy_;
};

}  // namespace flexneck::multibody
