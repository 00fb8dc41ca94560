// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "fe_modal/body/modal_body.h"
#include "geometry/neck/neck_parameters.h"
#include "pipeline/results/plotting/drawing.h"

namespace flexneck::pipeline {

/// The layers of the neck in its plane of symmetry, x forward and z upwards, inches, each a closed
/// line that moves with the neck, in the neck's own frame.
class NeckOutline {
 public:
  explicit NeckOutline(const geometry::NeckParameters& neck);

  /// Displaces the outline by the sum of shapes times coordinates; each point takes the displaced
  /// position of the nearest node.
  void deform(const fe_modal::ModalBody& body, const std::vector<Eigen::Index>& modes,
              const Eigen::VectorXd& coordinates);

  /// The layers as shapes of a drawing, rotated and shifted.
  std::vector<Drawing::Shape> shapes(const Eigen::Matrix2d& turn,
                                     const Eigen::Vector2d& shift_in) const;
  /// The layers as lines only; the suffix is appended to their names.
  std::vector<Drawing::Shape> lines(const Eigen::Matrix2d& turn, const Eigen::Vector2d& shift_in,
                                    const std::string& suffix, const std::string& style) const;

 private:
  struct Layer {
    std::string part;
    bool is_rubber = false;
    Eigen::Matrix2Xd points_m;
  };
  std::vector<Layer> layers_;
};

}  // namespace flexneck::pipeline
