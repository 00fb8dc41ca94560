// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/results/tables/simulated_output.h"

#include <algorithm>
#include <utility>

#include "geometry/foundation/available_disk.h"
#include "geometry/foundation/available_memory.h"
#include "multibody/history/history_arrays.h"
#include "pipeline/run/results_folder.h"

namespace flexneck::pipeline {

using Eigen::Index;
using multibody::Channel;
using multibody::History;

namespace {

template <class Histories>
void keep_named(Histories& histories, const std::vector<std::string>& names) {
  std::erase_if(histories, [&](const auto& each) {
    return std::find(names.begin(), names.end(), each.name) == names.end();
  });
}

Index rows_of(const std::vector<Channel>& channels) {
  Index rows = 0;
  for (const Channel& channel : channels) rows += channel.values.rows();
  return rows;
}

}  // namespace

SimulatedOutput::SimulatedOutput(const ModelFile& model, std::filesystem::path history,
                                 const std::filesystem::path& table, Index outputs)
    : model_(model), path_(std::move(history)), outputs_(outputs), specs_(model.output.channels) {
  if (!path_.empty()) history_.emplace(path_);
  if (!table.empty()) table_.emplace(table);
  has_filters_ = std::any_of(specs_.begin(), specs_.end(),
                             [](const ChannelSpec& spec) { return spec.filter.has_value(); });
}

SimulatedOutput::Block SimulatedOutput::derived(const History& outputs) {
  Block block{outputs, {}};
  keep_named(block.history.markers, model_.output.markers);
  keep_named(block.history.joints, model_.output.joints);
  // Chosen channels may need any marker; by default the written markers and joints are shown.
  const bool is_chosen = !model_.output.channels.empty();
  const History& source = is_chosen ? outputs : block.history;
  if (specs_.empty()) specs_ = all_channels(source);
  last_.resize(specs_.size());
  for (std::size_t k = 0; k < specs_.size(); ++k) {
    ChannelSpec unfiltered = specs_[k];
    unfiltered.filter.reset();
    Channel channel = channel_of(source, unfiltered, model_.model.gravity_m_s2);
    if (last_[k].size() > 0) continue_channel(unfiltered.quantity, last_[k], channel.values);
    if (channel.values.cols() > 0) last_[k] = channel.values.rightCols<1>();
    block.channels.push_back(std::move(channel));
  }
  return block;
}

void SimulatedOutput::require_room(const Block& first) const {
  constexpr double kTextOfNumber = 20;  // bytes in the table, including the comma
  const auto outputs = static_cast<double>(outputs_);
  const auto shown = static_cast<double>(1 + rows_of(first.channels));
  const auto stored = static_cast<double>(multibody::numbers_per_output(first.history)) + shown;
  const std::string what = "the history of " + std::to_string(outputs_) + " outputs";
  const std::string advice = "increase the output interval, or choose markers, joints or channels";
  require_disk(path_.parent_path(), what,
               outputs * (sizeof(double) * stored + kTextOfNumber * shown), advice);
  if (has_filters_)
    require_memory("with filtered channels, " + what, outputs * sizeof(double) * shown, advice);
}

void SimulatedOutput::append(const History& outputs) {
  const Block block = derived(outputs);
  if (outputs.handed_on == 0) require_room(block);
  if (has_filters_) {
    keep(block);
    history_->append(block.history, {});
  } else {
    show(block.history.time_s, block.channels);
    history_->append(block.history, block.channels);
  }
}

void SimulatedOutput::keep(const Block& block) {
  const Index begin = block.history.handed_on;
  const Index count = block.history.time_s.size();
  if (begin == 0) {
    kept_time_s_.resize(outputs_);
    kept_ = block.channels;
    for (Channel& channel : kept_) channel.values.resize(channel.values.rows(), outputs_);
  }
  kept_time_s_.segment(begin, count) = block.history.time_s;
  for (std::size_t k = 0; k < kept_.size(); ++k)
    kept_[k].values.middleCols(begin, count) = block.channels[k].values;
}

std::vector<Channel> SimulatedOutput::take_kept() {
  for (std::size_t k = 0; k < kept_.size(); ++k) {
    kept_[k].values.conservativeResize(Eigen::NoChange, kept_time_s_.size());
    if (specs_[k].filter) filter_channel(kept_time_s_, *specs_[k].filter, kept_[k]);
  }
  return std::move(kept_);
}

void SimulatedOutput::show(const Eigen::VectorXd& time_s, const std::vector<Channel>& channels) {
  if (table_) table_->append(time_s, channels);
  peaks_.append(time_s, channels);
}

multibody::HistoryFile SimulatedOutput::finish(
    const History& last, std::optional<multibody::LinearisationRecord> linearisation) {
  Block block = derived(last);
  multibody::HistoryFile file;
  if (has_filters_) {
    keep(block);
    kept_time_s_.conservativeResize(last.handed_on + last.time_s.size());
    file.channels = take_kept();
    show(kept_time_s_, file.channels);
  } else {
    show(last.time_s, block.channels);
    file.channels = std::move(block.channels);
  }
  file.history = std::move(block.history);
  file.provenance = provenance_of(model_.files, model_.parameters);
  file.linearisation = std::move(linearisation);
  if (history_) history_->finish(file);
  if (table_) table_->commit();
  return file;
}

}  // namespace flexneck::pipeline
