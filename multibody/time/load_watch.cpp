// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/time/load_watch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "multibody/numerics/rotation.h"

namespace flexneck::multibody {
namespace {

constexpr std::array<double, 6> kStages = {0, 1. / 5, 3. / 10, 4. / 5, 8. / 9, 1};
constexpr std::array<double, 2> kEnds = {0, 1};
/// Fractions of the largest load in the step by which samples may differ from the method's
/// interpolation.
constexpr double kOfStages = 1e-3;
constexpr double kOfEnds = 1e-2;
/// Fraction of the largest load so far below which loads do not matter, such as the foot of a bell
/// curve.
constexpr double kNegligible = 1e-9;
/// Steps down to this fraction of the resolution sample features that are as long as the
/// resolution, with at least kFewest samples per step.
constexpr double kShortest = 1. / 256;
constexpr std::size_t kFewest = 8;
/// Smallest fraction to which a step is shortened where a missed feature begins; else it is halved.
constexpr double kLeastShare = 0.25;

/// The polynomial through the values of a function at `nodes`.
template <class Value>
Value polynomial_at(std::span<const double> nodes, const std::array<Value, 6>& values, double x) {
  Value sum = Value::Zero();
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    double weight = 1;
    for (std::size_t j = 0; j < nodes.size(); ++j)
      if (j != i) weight *= (x - nodes[j]) / (nodes[i] - nodes[j]);
    sum += weight * values[i];
  }
  return sum;
}

}  // namespace

LoadWatch::LoadWatch(const ForceSet& forces, double resolution_s)
    : forces_(forces), resolution_s_(resolution_s) {
  begin();
  end_ = begin_;
  largest_.assign(begin_.size(), Load::Zero());
}

void LoadWatch::take(std::vector<RelativeMotion>& motions) const {
  motions.clear();
  forces_.each_function(
      [&](const FunctionForce&, const MarkerKinematics& i, const MarkerKinematics& j) {
        motions.push_back(relative_motion(i, j));
      });
}

void LoadWatch::begin() { take(begin_); }

/// Motion at a fraction of the step: Hermite's cubic of the position, whose derivative is the
/// velocity.
RelativeMotion LoadWatch::Motions::at(double s) const {
  const double r = 1 - s;
  const Eigen::Vector3d rise = end.position_m - begin.position_m;
  const Eigen::Vector3d from = length_s * begin.velocity_m_s - rise;
  const Eigen::Vector3d to = rise - length_s * end.velocity_m_s;
  RelativeMotion motion;
  motion.position_m = begin.position_m + s * rise + s * r * (r * from + s * to);
  motion.velocity_m_s = (rise + (r - s) * (r * from + s * to) + s * r * (to - from)) / length_s;
  motion.rotation = begin.rotation * rotation_exp(s * turn);
  motion.angular_velocity_rad_s = r * begin.angular_velocity_rad_s + s * end.angular_velocity_rad_s;
  return motion;
}

bool LoadWatch::is_blind_to(double length_s) const { return length_s < kShortest * resolution_s_; }

double LoadWatch::share_seen(double begin_s, double length_s, Method method) {
  take(end_);
  if (is_blind_to(length_s)) return 1;
  // The samples are closer than the resolution: no feature of that length lies between two.
  const auto count = std::max(kFewest, static_cast<std::size_t>(length_s / resolution_s_) + 1);
  std::size_t missed = count;
  std::size_t k = 0;
  forces_.each_function([&](const FunctionForce& force, const auto&, const auto&) {
    const Motions motions{begin_[k], end_[k], length_s,
                          rotation_log(begin_[k].rotation.transpose() * end_[k].rotation)};
    missed = std::min(missed, first_missed(force, motions, begin_s, count, method, largest_[k]));
    ++k;
  });
  if (missed == count) return 1;
  const double before = static_cast<double>(missed - 1) / static_cast<double>(count);
  return before >= kLeastShare ? before : 0.5;
}

/// Index of the first sample, from 1 to count - 1, that the method misses; count if there is none.
std::size_t LoadWatch::first_missed(const FunctionForce& force, const Motions& motions,
                                    double begin_s, std::size_t count, Method method,
                                    Load& largest) {
  const auto load_at = [&](double share) {
    const FunctionLoad found = force.load(begin_s + share * motions.length_s, motions.at(share));
    Load load;
    load << found.force_N, found.moment_Nm;
    return load;
  };
  const bool has_stages = method == Method::six_stages;
  const std::span<const double> nodes =
      has_stages ? std::span<const double>(kStages) : std::span<const double>(kEnds);
  std::array<Load, 6> taken;
  Load size = Load::Zero();
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    taken[k] = load_at(nodes[k]);
    size = size.cwiseMax(taken[k].cwiseAbs());
  }
  samples_.resize(count);
  for (std::size_t k = 1; k < count; ++k) {
    samples_[k] = load_at(static_cast<double>(k) / static_cast<double>(count));
    size = size.cwiseMax(samples_[k].cwiseAbs());
  }
  largest = largest.cwiseMax(size);
  const Load allowed = (has_stages ? kOfStages : kOfEnds) * size + kNegligible * largest;
  for (std::size_t k = 1; k < count; ++k) {
    const double share = static_cast<double>(k) / static_cast<double>(count);
    const Load missed = (samples_[k] - polynomial_at(nodes, taken, share)).cwiseAbs();
    if (!(missed.array() <= allowed.array()).all()) return k;
  }
  return count;
}

}  // namespace flexneck::multibody
