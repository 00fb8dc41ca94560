// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include <Eigen/Core>

#include "multibody/equations/equations.h"
#include "multibody/time/event_search.h"
#include "multibody/time/iteration_matrix.h"
#include "multibody/time/time_integrator.h"

namespace flexneck::multibody {

/// Parameters of the generalised-alpha method of order 2 by its spectral radius at infinite
/// frequency (Chung and Hulbert, J. Appl. Mech. 60, 1993): 1 damps nothing, 0 annihilates
/// unresolved vibrations in one step.
struct AlphaParameters {
  explicit AlphaParameters(double spectral_radius);

  double alpha_m, alpha_f, gamma, beta;
  double shift;     ///< the auxiliary a_n is V' at t_n + shift h, up to second order
  double quotient;  ///< d a_n+1 / d V'_n+1
  double error;     ///< local error of the positions over h^3 V''
};

/// The generalised-alpha method on a Lie group for equations of index 3 (Arnold and Bruels,
/// Multibody Syst. Dyn. 18, 2007; Bruels, Cardona and Arnold, Mech. Mach. Theory 48, 2012), order
/// 2:
///   Q_n+1 = Q_n (+) (h V_n + h^2 ((1/2 - beta) a_n + beta a_n+1))
///   V_n+1 = V_n + h ((1 - gamma) a_n + gamma a_n+1)
///   (1 - alpha_m) a_n+1 + alpha_m a_n = (1 - alpha_f) V'_n+1 + alpha_f V'_n
/// with equations of motion and constraints satisfied at the end of the step. Stable for stiff
/// forces at any step; vibrations that a step does not resolve decay. Newton's matrix is kept while
/// it converges. The local error of the positions, less its part in stiff modes, determines the
/// step; inside a step the state is Hermite's cubic, for the positions in the displacement from its
/// beginning: a step may rotate far. Steps end at kinks of loads. A stop met there excites a stiff
/// mode that does matter: the error of the step after it is not reduced.
class GeneralisedAlpha final : public TimeIntegrator {
 public:
  /// @param equations  must outlive this
  /// @param y          state that satisfies the joints
  GeneralisedAlpha(Equations& equations, double spectral_radius, StepLimits limits, double time_s,
                   const Vector& y);

  void restart() override { fresh_ = false; }
  void step(double limit_s) override;
  /// Takes a step of the given length, whatever its error.
  /// @throws ComputationError if Newton's method does not converge.
  void fixed_step(double length_s);
  void interpolate(double time_s, Vector& y) const override;
  std::string name_of_event(std::size_t event) const override {
    return equations_.forces().name_of_piece(event);
  }
  std::string name_of(std::size_t component) const override {
    return equations_.name_of(component);
  }
  /// Number of linearisations of the equations.
  int linearisations() const { return linearisations_; }

 private:
  /// V' and multipliers, and the corresponding auxiliary accelerations.
  struct Accelerations {
    Vector V_rate, lambda, a;
  };

  void begin(double length_s);
  void linearise(double length_s);
  /// @return true if Newton's method converged.
  bool attempt(double length_s);
  bool iterate(double length_s);
  void predict(double length_s);
  void update_end(double length_s);
  /// Size of a displacement q d at the end of the step, relative to the tolerance.
  ErrorEstimate size_of(const Vector& d, double q);
  ErrorEstimate local_error(double length_s);
  /// Tries a step and estimates its error.
  /// @return true if Newton's method converged
  bool tried(double length_s);
  /// As tried(); a step that would pass a kink of a load is shortened to before it, or passes it if
  /// it is close.
  bool try_step(double& length_s);
  // The fraction of the tried step at which a piece is left: on its dense output if its end is on
  // the same piece, otherwise on the prediction.
  double share_inside(double length_s);
  double share_on_prediction(double length_s);
  struct Step {
    const Vector &y_begin, &rate_begin, &y_end, &rate_end;
    const Vector& displacement;  ///< displacement of the positions over the step
    double length_s;
  };
  void interpolate_between(const Step& step, double share, Vector& y) const;
  void accept(double length_s);
  double first_step() const;
  [[noreturn]] void give_up(double length_s) const;

  Equations& equations_;
  AlphaParameters alpha_;
  Eigen::Index nq_, nv_, ni_, nc_;
  IterationMatrix matrix_;
  Accelerations now_, next_, before_;
  Vector offset_rate_;                         ///< (a_n - V'_n) / h
  Vector displacement_, displacement_before_;  ///< over the step tried, over the last one
  mutable Vector moved_;                       ///< from the beginning of a step to a time inside
  Vector residual_, change_, error_;
  Vector y_next_, y_before_, y_trial_;
  Vector rate_, rate_next_, rate_before_, rate_trial_;
  double previous_time_s_;
  double last_length_s_ = 0;  ///< zero after a restart: no extrapolation
  double proposed_s_ = 0;     ///< zero: not yet chosen
  double factorised_for_s_ = 0;
  EventSearch events_;
  bool fresh_ = false;            ///< `now_` and rate_ belong to the present state
  double approached_from_s_ = 0;  ///< length of the step that would pass the kink ahead
  bool crosses_ = false;          ///< the step tried passes the kink
  bool met_stop_ = false;         ///< the last step passed one, along a deflection
  bool linearised_ = false;       ///< true once linearise() was called
  int linearisations_ = 0;
};

}  // namespace flexneck::multibody
