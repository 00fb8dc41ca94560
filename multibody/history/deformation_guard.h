// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "multibody/model/model.h"

namespace flexneck::multibody {

/// Monitors how far deformable bodies leave the small deformations for which they are linear in
/// their own frames, by the rotations and displacements of their interfaces and by the root mean
/// square displacement of their mass, |a| / sqrt(m).
///
/// | measure                                    | warns above   | ends the run above |
/// |--------------------------------------------|---------------|--------------------|
/// | rotation of an interface                   | 1 rad         | 2 pi rad           |
/// | displacement against the body's length     | 1/2           | 5                  |
///
/// A bar bent evenly by 1 rad is a tenth longer along its chord; results at a full turn or five
/// lengths are meaningless.
class DeformationGuard {
 public:
  using ConstVector = Eigen::Ref<const Eigen::VectorXd>;

  explicit DeformationGuard(const Model& model);

  /// @param body  index among the model's; bodies without modes are not checked
  /// @throws ComputationError naming the body, the deformation and the time, beyond the last
  /// column.
  void check(double time_s, std::size_t body, const ConstVector& a) {
    if (!(a.squaredNorm() <= safe_[body])) check_large(time_s, body, a);
  }

  /// A warning for each body that exceeded the first limit, with the time when it began and its
  /// largest deformation.
  std::vector<std::string> warnings() const;

 private:
  struct Deformation {
    double of_limit = 0;  ///< relative to the limit of warnings
    double value = 0;     ///< rad, or lengths of the body
    bool turns = false;
    const fe_modal::Interface* interface = nullptr;  ///< null: displacement of the mass
    double time_s = 0;
  };
  struct Watched {
    const DeformableBody* body = nullptr;
    std::string name;
    double length_m = 0;
    double mass_kg = 0;
    Deformation largest = {};
    double since_s = 0;  ///< time of the first warning
  };

  void check_large(double time_s, std::size_t body, const ConstVector& a);
  static std::string text_of(const Deformation& found);

  std::vector<std::optional<Watched>> bodies_;  ///< by the model's bodies
  /// By body: the largest |a|^2 for which no warning is possible.
  std::vector<double> safe_;
};

}  // namespace flexneck::multibody
