// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/mesh/refined_nodes.h"

#include <algorithm>
#include <cmath>

namespace flexneck::mesher {
namespace {

/// A weight in units of 1/4096: weights are multiples of 1/64, except for rounding.
std::int64_t in_4096ths(double value) { return std::llround(4096 * value); }

}  // namespace

// Where elements are divided into eight, there are about eight times as many nodes.
RefinedNodes::RefinedNodes(std::size_t old_count)
    : old_count_(old_count), numbers_(8 * old_count, Hash{this}, Same{this}) {}

std::int32_t RefinedNodes::number(const Position& position) {
  if (const std::optional<std::int32_t> known = find(position)) return *known;
  const auto next = static_cast<std::int32_t>(size());
  positions_.push_back(position);
  numbers_.insert(next);
  return next;
}

std::optional<std::int32_t> RefinedNodes::find(const Position& position) const {
  if (position.weights.size() == 1) return position.node_of(position.weights.front());
  const auto found = numbers_.find(position);
  return found == numbers_.end() ? std::nullopt : std::optional(*found);
}

std::size_t RefinedNodes::weight_count() const {
  std::size_t sum = old_count_;
  for (const Position& position : positions_) sum += position.weights.size();
  return sum;
}

void RefinedNodes::find_weights(std::size_t number, std::vector<NodeWeight>& weights) const {
  weights.clear();
  if (number < old_count_) {
    weights.push_back({static_cast<std::int32_t>(number), 1.0});
    return;
  }
  const Position& position = positions_[number - old_count_];
  for (const NodeWeight& weight : position.weights) {
    weights.push_back({position.node_of(weight), weight.value});
  }
}

std::size_t RefinedNodes::Hash::operator()(const Position& position) const {
  std::size_t sum = 0;
  for (const NodeWeight& weight : position.weights) {
    std::size_t hash = (static_cast<std::size_t>(position.node_of(weight)) << 16U) ^
                       static_cast<std::size_t>(in_4096ths(weight.value));
    hash *= 0x9E3779B97F4A7C15ULL;
    sum += hash ^ (hash >> 29U);
  }
  return sum;
}

bool RefinedNodes::Same::operator()(const Position& position, std::int32_t number) const {
  const Position& known = nodes->new_position(number);
  const auto is_known = [&](const NodeWeight& weight) {
    return std::any_of(known.weights.begin(), known.weights.end(), [&](const NodeWeight& other) {
      return known.node_of(other) == position.node_of(weight) &&
             in_4096ths(other.value) == in_4096ths(weight.value);
    });
  };
  return position.weights.size() == known.weights.size() &&
         std::all_of(position.weights.begin(), position.weights.end(), is_known);
}

}  // namespace flexneck::mesher
