// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "multibody/model/model.h"

namespace flexneck::multibody {

/// Watches how far deformable bodies leave the small deformations for which they are linear in
/// their own frames: by the rotations and displacements of their interfaces and by the root mean
/// square displacement of their mass, |a| / sqrt(m).
///
/// | measure                                    | is told above | ends the run above |
/// |--------------------------------------------|---------------|--------------------|
/// | rotation of an interface                   | 1 rad         | 2 pi rad           |
/// | displacement against the body's length     | 1/2           | 5                  |
///
/// A bar bent evenly by 1 rad is longer by a tenth along its chord; a whole turn and five lengths
/// mean nothing.
class DeformationGuard {
 public:
  using ConstVector = Eigen::Ref<const Eigen::VectorXd>;

  explicit DeformationGuard(const Model& model);

  /// @param body  among the model's; nothing is checked of one that has no modes
  /// @throws ComputationError naming the body, what deforms and when, beyond the last column.
  void check(double time_s, std::size_t body, const ConstVector& a) {
    if (!(a.squaredNorm() <= safe_[body])) check_large(time_s, body, a);
  }

  /// A sentence for each body that was beyond the first, from when on and its largest deformation.
  std::vector<std::string> warnings() const;

 private:
  struct Deformation {
    double of_limit = 0;  ///< against what is told
    double value = 0;     ///< rad, or lengths of the body
    bool turns = false;
    const fe_modal::Interface* interface = nullptr;  ///< none: the mass is displaced
    double time_s = 0;
  };
  struct Watched {
    const DeformableBody* body = nullptr;
    std::string name;
    double length_m = 0;
    double mass_kg = 0;
    Deformation largest = {};
    double since_s = 0;  ///< what is told begins
  };

  void check_large(double time_s, std::size_t body, const ConstVector& a);
  static std::string text_of(const Deformation& found);

  std::vector<std::optional<Watched>> bodies_;  ///< of the model
  /// Of the bodies: |a|^2 up to which nothing can be beyond what is told.
  std::vector<double> safe_;
};

}  // namespace flexneck::multibody
