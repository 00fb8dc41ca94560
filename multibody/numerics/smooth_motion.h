// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "multibody/numerics/piecewise_fit.h"

namespace flexneck::multibody {

/// A motion along a line given by a function of time, with its exact derivatives or integrals:
/// pieces in Chebyshev polynomials (PiecewiseFit). Pieces end where the function has a kink or a
/// jump. By default there is no motion.
class SmoothMotion {
 public:
  using Function = std::function<double(double)>;

  SmoothMotion() = default;
  /// Motion with a given displacement.
  /// @param displacement_m  function of time in s over [0, end_s], without a jump or a kink
  /// @throws InputError if it has one, or is not finite.
  static SmoothMotion of_displacement(const Function& displacement_m, double end_s,
                                      const Sampling& sampling = {});
  /// Motion with a given acceleration, from displacement and velocity zero at time zero.
  /// @param acceleration_m_s2  function of time in s, piecewise smooth over [0, end_s]
  /// @throws InputError if it is not, or not finite.
  static SmoothMotion of_acceleration(const Function& acceleration_m_s2, double end_s,
                                      const Sampling& sampling = {});

  /// Motion through the rows of a table: the cubic spline with two continuous derivatives whose
  /// third does not jump at the second row and the last but one (de Boor, A Practical Guide to
  /// Splines, IV), exact for a cubic. Its third derivative jumps at the rows between, which are
  /// breakpoints.
  /// @param times_s  strictly increasing, four or more
  /// @throws InputError otherwise, or for values that are not finite.
  static SmoothMotion of_displacement_table(const std::vector<double>& times_s,
                                            const std::vector<double>& displacement_m);

  /// Returns whether there is no motion, as by default.
  bool is_none() const { return pieces_.empty(); }

  // Outside [0, end_s()] the outermost pieces are extrapolated.
  double displacement_m(double time_s) const;
  double velocity_m_s(double time_s) const;
  double acceleration_m_s2(double time_s) const;

  /// Times of kinks and jumps, including those of the second derivative; ascending.
  const std::vector<double>& breakpoints_s() const { return breakpoints_s_; }
  /// Adds the ends of equal parts of the pieces that overlap an interval, if the parts are shorter
  /// than a step may be: steps within them meet every feature of the motion.
  void add_piece_ends(double begin_s, double end_s, int parts, double max_step_s,
                      std::vector<double>& times_s) const;
  /// Time up to which the motion is given; zero by default.
  double end_s() const { return pieces_.empty() ? 0 : pieces_.back().end_s; }

  using Series = ChebyshevSeries;
  struct Piece {
    double begin_s, end_s;
    Series displacement, velocity, acceleration;
  };

  /// Serialises its fields (geometry/foundation/byte_archive.h).
  template <class Archive>
  void archive(Archive& all) {
    all(pieces_, breakpoints_s_);
  }

 private:
  const Piece& piece_at(double time_s) const;
  double value(double time_s, Series Piece::*series) const;

  std::vector<Piece> pieces_;
  std::vector<double> breakpoints_s_;
};

}  // namespace flexneck::multibody
