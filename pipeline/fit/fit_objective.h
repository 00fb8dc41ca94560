// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace flexneck::pipeline {

/// What is free, in its own unit.
struct FitRange {
  struct Normal {
    double mean = 0;
    double deviation = 1;
  };
  std::string name;
  double from = 0;
  double to = 1;
  std::optional<Normal> prior;  ///< cut off at the bounds; none: a uniform one

  double width() const { return to - from; }
};

/// What an observable should be: a value with a standard deviation, or a window.
///
/// All of a window is equally likely. While fitting, what lies outside counts by its distance from
/// the nearer edge in units of the smoothing, so that the sum of squares leads back in; whether a
/// window is met is judged by its edges alone.
struct FitTerm {
  struct Window {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
  };
  std::string target;  ///< that it is of; a curve has many
  double value = 0;
  double deviation = 1;          ///< > 0; of a window the smoothing
  std::optional<Window> window;  ///< in place of the value
  bool is_held_out = false;      ///< predicted only
  bool must_hold = false;        ///< a window that a fit keeps to instead of counting it

  /// In standard deviations; 0 in a window.
  double residual(double observed) const;
  /// d residual / d observed.
  double slope(double observed) const;
  /// Whether a window holds it, or it lies within some standard deviations of the value.
  bool is_met(double observed, double deviations) const;
};

struct ModelSlopes {
  Eigen::VectorXd values;       ///< (n) observables
  Eigen::MatrixXd derivatives;  ///< (n, p) by the parameters
};

/// What is fitted: observables as functions of parameters in their own units. Both throw
/// InputError or ComputationError where there are none.
struct FitModel {
  std::function<Eigen::VectorXd(const Eigen::VectorXd& parameters)> values;
  std::function<ModelSlopes(const Eigen::VectorXd& parameters)> slopes;
};

/// Slopes by central differences over two thousandths of each range, at a bound by one-sided ones
/// of second order. @param threads  that evaluate, one model each
std::function<ModelSlopes(const Eigen::VectorXd&)> central_differences(
    std::function<Eigen::VectorXd(const Eigen::VectorXd&)> values, std::vector<FitRange> ranges,
    unsigned threads = 1);

/// Weighted residuals of a model. Places are in the unit cube: 0 is the lower bound of a parameter,
/// 1 the upper one. Terms that are held out or must hold take no part. Residuals are those of the
/// terms, then those of normal priors, then zeros if there are fewer than parameters.
class FitObjective {
 public:
  FitObjective(std::vector<FitRange> ranges, std::vector<FitTerm> terms, FitModel model);

  Eigen::Index parameter_count() const { return static_cast<Eigen::Index>(ranges_.size()); }
  Eigen::Index residual_count() const { return residual_count_; }
  /// Of targets and priors, without the zeros.
  Eigen::Index told_count() const { return told_count_; }
  const std::vector<FitRange>& ranges() const { return ranges_; }
  const std::vector<FitTerm>& terms() const { return terms_; }
  const FitModel& model() const { return model_; }
  /// Whether there are windows that must hold.
  bool has_limits() const;
  /// Positions in terms() of those that are fitted: residual k is of term fitted()[k].
  const std::vector<std::size_t>& fitted() const { return fitted_; }

  Eigen::VectorXd parameters(const Eigen::VectorXd& place) const;
  Eigen::VectorXd place(const Eigen::VectorXd& parameters) const;
  /// @param values  observables there
  Eigen::VectorXd residuals(const Eigen::VectorXd& place, const Eigen::VectorXd& values) const;
  /// Where the model may fail: then all of them are very bad, and the problem says why.
  /// @param values  of the model
  /// @throws std::bad_alloc
  Eigen::VectorXd residuals_or_bad(
      const Eigen::VectorXd& place,
      const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& values,
      std::string& problem) const;
  /// By the place, (residuals, p).
  Eigen::MatrixXd jacobian(const ModelSlopes& slopes) const;

 private:
  std::vector<FitRange> ranges_;
  std::vector<FitTerm> terms_;
  FitModel model_;
  std::vector<std::size_t> fitted_;
  Eigen::Index told_count_ = 0;
  Eigen::Index residual_count_ = 0;
};

}  // namespace flexneck::pipeline
