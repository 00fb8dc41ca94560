// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/equations/force_set.h"

#include <algorithm>

namespace flexneck::multibody {

using Eigen::Index;

std::vector<InternalBlock> internal_blocks(const Forces& forces) {
  std::vector<InternalBlock> blocks;
  Index begin = 0;
  forces.each_kind([&]<class Kind>(const std::vector<Kind>& elements) {
    if constexpr (RelaxingForce<Kind>)
      for (const Kind& element : elements)
        for (std::size_t branch = 0; branch < element.branch_count(); ++branch) {
          blocks.push_back({begin, element.branch_size()});
          begin += element.branch_size();
        }
  });
  return blocks;
}

Index internal_count(const Forces& forces) {
  const std::vector<InternalBlock> blocks = internal_blocks(forces);
  return blocks.empty() ? 0 : blocks.back().begin + blocks.back().size;
}

std::string name_of_branch(const Forces& forces, std::size_t branch) {
  std::string who;
  std::size_t before = 0;
  forces.each_kind([&]<class Kind>(const std::vector<Kind>& elements) {
    if constexpr (RelaxingForce<Kind>)
      for (const Kind& element : elements) {
        if (before <= branch && branch < before + element.branch_count())
          who = "relaxation of " + title(element);
        before += element.branch_count();
      }
  });
  return who;
}

ForceSet::ForceSet(const Model& model)
    : model_(model),
      internal_(Eigen::VectorXd::Zero(internal_count(model.forces))),
      internal_rate_(internal_),
      given_(internal_),
      begin_(internal_),
      begin_rate_(internal_),
      steps_(internal_blocks(model.forces).size()) {
  for (const Joint& joint : model.joints) angles_.push_back({.angle_rad = joint.start_angle_rad});
  for (const JointResistance& each : model.forces.of<JointResistance>())
    if (each.coordinate == JointCoordinate::angle) turned_joints_.push_back(each.joint);
  model.forces.each_kind([&]<class Kind>(const std::vector<Kind>& elements) {
    for (const Kind& element : elements) {
      auto slots = element.markers(model.joints);
      for (std::size_t& marker : slots) marker = slot_of(marker);
      std::get<Slots<Kind>>(slots_of_kind_).of_element.push_back(slots);
      if constexpr (PiecewiseForce<Kind>) {
        pieces_.insert(pieces_.end(), 2, 0);
        kinks_.insert(kinks_.end(), 2, {});
      }
    }
  });
}

std::vector<std::vector<std::size_t>> ForceSet::markers_of_elements() const {
  std::vector<std::vector<std::size_t>> markers;
  model_.forces.each_kind([&]<class Kind>(const std::vector<Kind>& elements) {
    for (const Kind& element : elements) {
      const auto of_element = element.markers(model_.joints);
      markers.emplace_back(of_element.begin(), of_element.end());
    }
  });
  return markers;
}

std::string ForceSet::name_of_piece(std::size_t index) const {
  std::string who;
  std::string_view what = is_deflection(index) ? "it reaches a stop or a kink of its curve"
                                               : "its friction or hysteresis reverses";
  std::size_t before = 0;
  model_.forces.each_kind([&]<class Kind>(const std::vector<Kind>& elements) {
    if constexpr (PiecewiseForce<Kind>) {
      const std::size_t at = index / 2;
      if (before <= at && at < before + elements.size()) {
        who = title(elements[at - before]);
        if constexpr (NamedKink<Kind>) what = Kind::kKink;
      }
      before += elements.size();
    }
  });
  return who + ": " + std::string(what);
}

std::size_t ForceSet::slot_of(std::size_t marker) {
  const auto found = std::find(markers_.begin(), markers_.end(), marker);
  if (found != markers_.end()) return static_cast<std::size_t>(found - markers_.begin());
  const Body& body = model_.bodies[model_.markers[marker].body];
  markers_.push_back(marker);
  slots_.emplace_back();
  prescribed_.push_back(std::holds_alternative<PrescribedBody>(body.kind));
  return markers_.size() - 1;
}

void ForceSet::give_internal(const ConstVector& values) {
  given_ = values;
  known_ = InternalVariables::Known::now;
}

void ForceSet::begin_step(const ConstVector& values, const ConstVector& rates, double length_s) {
  begin_ = values;
  begin_rate_ = rates;
  BranchStep* step = steps_.data();
  model_.forces.each_kind([&]<class Kind>(const std::vector<Kind>& elements) {
    if constexpr (RelaxingForce<Kind>)
      for (const Kind& element : elements)
        for (std::size_t branch = 0; branch < element.branch_count(); ++branch)
          *step++ = BranchStep::over(length_s, element.relaxation_time_s(branch));
  });
}

InternalVariables ForceSet::internal_variables() {
  const bool in_step = known_ == InternalVariables::Known::begin;
  return {known_,
          in_step ? begin_.data() : given_.data(),
          begin_rate_.data(),
          steps_.data(),
          internal_.data(),
          internal_rate_.data()};
}

void ForceSet::evaluate(double time_s) {
  if (slots_.empty()) return;
  sums_ = {};
  for (ForceMarker& slot : slots_) {
    slot.force_N.setZero();
    slot.moment_Nm.setZero();
  }
  int* piece = pieces_.data();
  KinksAround* kinks = kinks_.data();
  InternalVariables internal = internal_variables();
  model_.forces.each_kind([&]<class Kind>(const std::vector<Kind>& elements) {
    const auto& slots = std::get<Slots<Kind>>(slots_of_kind_).of_element;
    for (std::size_t k = 0; k < elements.size(); ++k) {
      ForceMarker& i = slots_[slots[k].front()];
      ForceMarker& j = slots_[slots[k].back()];
      ForceLoad load;
      if constexpr (PiecewiseForce<Kind>) load.piece = {piece[0], piece[1]};
      ForceInput input{i, j, model_.joints, angles_, time_s};
      if constexpr (RelaxingForce<Kind>) {
        input.internal = internal;
        internal = internal.behind(elements[k].branch_size(),
                                   static_cast<Index>(elements[k].branch_count()));
      }
      elements[k].act(input, load, sums_);
      if constexpr (PiecewiseForce<Kind>) {
        *piece++ = load.piece.deflection;
        *piece++ = load.piece.rate;
        *kinks++ = load.piece.of_deflection;
        *kinks++ = load.piece.of_rate;
      }
      j.force_N += load.force_N;
      j.moment_Nm += load.moment_Nm;
      if constexpr (std::tuple_size_v<typename Slots<Kind>::Indices> == 2) {
        i.force_N -= load.force_N;
        i.moment_Nm -= load.moment_Nm + (j.p - i.p).cross(load.force_N);
      }
    }
  });
  // Power that loads give to prescribed bodies is not given to the others.
  for (std::size_t k = 0; k < slots_.size(); ++k)
    if (prescribed_[k])
      sums_.work_W -= slots_[k].force_N.dot(slots_[k].v) + slots_[k].moment_Nm.dot(slots_[k].w);
}

void ForceSet::add_breakpoints(std::vector<double>& times_s) const {
  model_.forces.each_kind([&]<class Kind>(const std::vector<Kind>& elements) {
    if constexpr (std::is_same_v<Kind, FunctionForce>)
      for (const Kind& element : elements)
        times_s.insert(times_s.end(), element.breakpoints_s.begin(), element.breakpoints_s.end());
    if constexpr (TimedForce<Kind>)
      for (const Kind& element : elements) {
        const std::vector<double>& rows = element.load_over_time().times_s();
        times_s.insert(times_s.end(), rows.begin(), rows.end());
      }
  });
}

}  // namespace flexneck::multibody
