// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "multibody/numerics/chebyshev_series.h"

namespace flexneck::multibody {

/// Sampling of a function of time.
struct Sampling {
  /// Features of the function that are longer than this are not missed.
  double resolution_s = 1e-4;
  /// Increasing: the function has 64 samples or more between two of them, however close they are.
  std::vector<double> breakpoints_s = {};
};

/// Refuses a motion.
/// @throws InputError "the motion <problem> at <time> s".
[[noreturn]] void refuse_motion(double time_s, const std::string& problem);

/// A function of time over [0, end] as pieces in Chebyshev polynomials. The function is sampled on
/// a grid, and a piece is halved until its last coefficients vanish and all samples inside it
/// agree, to 1e-12 of the function's largest value or to the effect of rounding the time. Pieces
/// end where the function is not smooth.
class PiecewiseFit {
 public:
  using Function = std::function<double(double)>;
  struct Piece {
    double begin_s, end_s;
    ChebyshevSeries series;
    double length_s() const { return end_s - begin_s; }
  };

  /// @throws InputError naming a time where the function is not finite or not piecewise smooth.
  PiecewiseFit(const Function& f, double end_s, const Sampling& sampling);

  const std::vector<Piece>& pieces() const { return pieces_; }
  /// Times at which it is not smooth, and the given breakpoints; ascending.
  const std::vector<double>& breaks_s() const { return breaks_; }
  /// Returns whether the derivative of an order jumps by more than rounding at the end of piece k.
  bool jumps(std::size_t k, int order) const;
  /// Returns whether over piece k, between two breaks close to each other, the rounding error of
  /// the derivative of order 1 or 2 exceeds its possible change there.
  bool loses(std::size_t k, int order) const;

 private:
  /// Equidistant samples between breakpoints.
  struct Grid {
    double begin_s, end_s, step_s;
    std::vector<double> values;
    double time_s(std::size_t k) const { return begin_s + static_cast<double>(k) * step_s; }
  };

  Grid sampled(double begin_s, double end_s);
  void cover_stretch(const Grid& grid, double begin_s, double end_s);
  std::optional<double> cover(const Grid& grid, double stretch_s, double begin_s, double end_s);
  std::optional<double> isolated_break(const Grid& grid, double stretch_s, double begin_s,
                                       double end_s) const;
  double locate(double begin_s, double end_s) const;
  Piece piece(double begin_s, double end_s) const;
  double tolerance(const Piece& piece) const;
  bool is_resolved(const Piece& piece) const;
  bool follows(const Grid& grid, const Piece& piece) const;
  void add(const Piece& piece);
  void add_break(double time_s);
  void find_hidden_breaks();
  double value(double time_s) const;

  const Function& f_;
  double resolution_s_;
  double shortest_s_;  ///< an unresolved piece of this length contains a kink or jump
  double rounding_s_;  ///< rounding of the time
  double scale_ = 0, curvature_ = 0;  ///< largest value and second derivative of the samples
  double steepest_ = 0;               ///< largest first derivative of the pieces
  std::vector<Piece> pieces_;
  std::vector<double> breaks_;
};

}  // namespace flexneck::multibody
