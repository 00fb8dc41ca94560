// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace flexneck::pipeline {

/// Range of a free parameter, in its own unit.
struct FitRange {
  struct Normal {
    double mean = 0;
    double deviation = 1;
  };
  std::string name;
  double from = 0;
  double to = 1;
  std::optional<Normal> prior;  ///< truncated at the bounds; none: a uniform prior

  double width() const { return to - from; }
};

/// Wanted value of an observable: a value with a standard deviation, or a window.
///
/// All values in a window are equally likely. While fitting, a value outside counts by its distance
/// from the nearer edge in units of the smoothing, so that the sum of squares leads back in;
/// whether a window is met is judged by its edges alone.
struct FitTerm {
  struct Window {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
  };
  std::string target;  ///< name of its target; a curve has many terms
  double value = 0;
  double deviation = 1;          ///< > 0; for a window its smoothing
  std::optional<Window> window;  ///< used instead of the value
  bool is_held_out = false;      ///< predicted only, not fitted
  bool must_hold = false;        ///< a window that is a constraint of the fit instead of a residual

  /// Residual in standard deviations; 0 inside a window.
  double residual(double observed) const;
  /// Derivative d residual / d observed.
  double slope(double observed) const;
  /// True if the value is inside the window, or within a number of standard deviations.
  bool is_met(double observed, double deviations) const;
};

struct ModelSlopes {
  Eigen::VectorXd values;       ///< (n) observables
  Eigen::MatrixXd derivatives;  ///< (n, p) with respect to the parameters
};

/// The fitted model: observables as functions of parameters in their own units. Both functions
/// throw InputError or ComputationError where the model fails.
struct FitModel {
  std::function<Eigen::VectorXd(const Eigen::VectorXd& parameters)> values;
  std::function<ModelSlopes(const Eigen::VectorXd& parameters)> slopes;
};

/// Slopes by central differences over two thousandths of each range, at a bound by one-sided ones
/// of second order. @param threads  number of threads that evaluate, one model each
std::function<ModelSlopes(const Eigen::VectorXd&)> central_differences(
    std::function<Eigen::VectorXd(const Eigen::VectorXd&)> values, std::vector<FitRange> ranges,
    unsigned threads = 1);

/// Weighted residuals of a model. Places are in the unit cube: 0 is the lower bound of a parameter,
/// 1 the upper one. Terms that are held out or constraints are excluded. Residuals are those of the
/// terms, then those of normal priors, then zeros if there are fewer than parameters.
class FitObjective {
 public:
  FitObjective(std::vector<FitRange> ranges, std::vector<FitTerm> terms, FitModel model);

  Eigen::Index parameter_count() const { return static_cast<Eigen::Index>(ranges_.size()); }
  Eigen::Index residual_count() const { return residual_count_; }
  /// Number of residuals of targets and priors, without the zeros.
  Eigen::Index told_count() const { return told_count_; }
  const std::vector<FitRange>& ranges() const { return ranges_; }
  const std::vector<FitTerm>& terms() const { return terms_; }
  const FitModel& model() const { return model_; }
  /// True if there are windows that are constraints.
  bool has_limits() const;
  /// Indices of the fitted terms in terms(): residual k belongs to term fitted()[k].
  const std::vector<std::size_t>& fitted() const { return fitted_; }

  Eigen::VectorXd parameters(const Eigen::VectorXd& place) const;
  Eigen::VectorXd place(const Eigen::VectorXd& parameters) const;
  /// @param values  observables at the place
  Eigen::VectorXd residuals(const Eigen::VectorXd& place, const Eigen::VectorXd& values) const;
  /// Residuals at a place where the model may fail: then all are very large, and the problem tells
  /// the reason.
  /// @param values  function that evaluates the model
  /// @throws std::bad_alloc
  Eigen::VectorXd residuals_or_bad(
      const Eigen::VectorXd& place,
      const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& values,
      std::string& problem) const;
  /// Derivatives by the place, (residuals, p).
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
