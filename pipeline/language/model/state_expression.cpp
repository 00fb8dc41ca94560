// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/language/model/state_expression.h"

#include <mutex>
#include <optional>
#include <vector>

#include "multibody/numerics/rotation.h"
#include "pipeline/language/model/expression.h"

namespace flexneck::pipeline {

namespace {

const std::vector<std::string>& variables() {
  static const std::vector<std::string> names = {"t",  "x",  "y",  "z",  "vx", "vy", "vz",
                                                 "rx", "ry", "rz", "wx", "wy", "wz"};
  return names;
}

}  // namespace

struct StateExpression::Impl {
  std::array<std::optional<Expression>, 6> components;
  bool takes_rotation_vector = false;
  std::mutex mutex;  ///< guards the parsers
};

StateExpression::StateExpression(const Texts& texts)
    : texts_(texts), impl_(std::make_shared<Impl>()) {
  for (std::size_t k = 0; k < texts.size(); ++k) {
    if (texts[k].empty()) continue;
    impl_->components[k].emplace(texts[k], variables());
    for (const char* const turn : {"rx", "ry", "rz"})
      if (impl_->components[k]->has(turn)) impl_->takes_rotation_vector = true;
  }
}

bool StateExpression::takes_rotation_vector() const { return impl_->takes_rotation_vector; }

multibody::FunctionLoad StateExpression::operator()(double time_s,
                                                    const multibody::RelativeMotion& motion) const {
  const Eigen::Vector3d turn = impl_->takes_rotation_vector
                                   ? multibody::rotation_log(motion.rotation)
                                   : Eigen::Vector3d::Zero();
  Eigen::Matrix<double, 13, 1> values;
  values << time_s, motion.position_m, motion.velocity_m_s, turn, motion.angular_velocity_rad_s;
  const std::scoped_lock lock(impl_->mutex);
  const auto component = [&](std::size_t k) {
    const std::optional<Expression>& text = impl_->components[k];
    return text ? (*text)(std::span<const double>(values.data(), 13)) : 0;
  };
  return {{component(0), component(1), component(2)}, {component(3), component(4), component(5)}};
}

}  // namespace flexneck::pipeline
