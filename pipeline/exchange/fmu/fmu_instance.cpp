// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/exchange/fmu/fmu_instance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "geometry/foundation/byte_archive.h"
#include "geometry/foundation/content_hash.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/output_file.h"
#include "multibody/files/model_archive.h"

namespace flexneck::multibody {

template <class A>
void archive(A& all, EnergyBooks& x) {
  auto& [are_open, balance, gravitational, dissipated, work, largest, worst, departs_at, departs,
         wrong_steps] = x;
  all(are_open, balance, gravitational, dissipated, work, largest, worst, departs_at, departs,
      wrong_steps);
}

template <class A>
void archive(A& all, SteppedRun::State& x) {
  auto& [time, y, pace, inputs, motions, angles, is_settled, first_energy, books] = x;
  all(time, y, pace.proposed_s, pace.error, inputs, motions, angles, is_settled, first_energy,
      books);
}

}  // namespace flexneck::multibody

namespace flexneck::pipeline {

using multibody::SteppedRun;

template <class A>
void archive(A& all, FmuInstance::State& x) {
  auto& [mode, tolerance, values, inputs, run, last] = x;
  all(mode, tolerance, values, inputs, run, last);
  if (mode < FmuInstance::Mode::instantiated || mode > FmuInstance::Mode::terminated)
    ByteReader::refuse();
}

FmuInstance::FmuInstance(FmuModel model)
    : model_(std::move(model)),
      variables_(variables_of(model_)),
      parameters_(parameters_of(model_.model)),
      last_(model_.channels.size()) {
  const auto count = [&](Causality causality) {
    return static_cast<Reference>(
        std::count_if(variables_.begin(), variables_.end(),
                      [&](const FmuVariable& each) { return each.causality == causality; }));
  };
  first_input_ = 1 + count(Causality::parameter);
  inputs_.assign(count(Causality::input), 0);
  first_output_ = first_input_ + static_cast<Reference>(inputs_.size());
}

const FmuVariable& FmuInstance::variable(Reference reference) const {
  if (reference >= variables_.size())
    throw InputError("there is no variable with the value reference " + std::to_string(reference));
  return variables_[reference];
}

SteppedRun& FmuInstance::run() {
  if (run_) return *run_;
  run_.emplace(model_.model, model_.solver, model_.kind, inputs_);
  return *run_;
}

void FmuInstance::require(Mode needed) const {
  constexpr std::array<const char*, 4> kNames = {"before initialization", "in initialization mode",
                                                 "in step mode", "terminated"};
  if (mode_ != needed)
    throw InputError(std::string("expected an FMU instance ") +
                     kNames[static_cast<std::size_t>(needed)] + ", found it " +
                     kNames[static_cast<std::size_t>(mode_)]);
}

void FmuInstance::begin_initialization(std::optional<double> relative_tolerance, double time_s) {
  require(Mode::instantiated);
  if (time_s != model_.model.start.time_s)
    throw InputError("the model starts at " + rounded_text(model_.model.start.time_s) +
                     " s, not at " + rounded_text(time_s) + " s");
  if (relative_tolerance) {
    model_.solver.relative_tolerance = *relative_tolerance;
    run_.reset();
  }
  mode_ = Mode::initialization;
}

void FmuInstance::end_initialization() {
  require(Mode::initialization);
  run();
  mode_ = Mode::step;
}

void FmuInstance::terminate() {
  require(Mode::step);
  mode_ = Mode::terminated;
}

double FmuInstance::time_s() { return run_ ? run_->time_s() : model_.model.start.time_s; }

void FmuInstance::advance(double time_s, double length_s, const SteppedRun::GoesOn& goes_on) {
  require(Mode::step);
  SteppedRun& run = this->run();
  // Importers accumulate their steps with rounding errors.
  constexpr double kRounding = 1e-9;
  if (std::abs(time_s - run.time_s()) > kRounding * std::max(length_s, std::abs(time_s)))
    throw InputError("expected a step from the current time of the instance, found one from " +
                     rounded_text(time_s) + " s at " + rounded_text(run.time_s()) + " s");
  if (!(length_s > 0 && std::isfinite(length_s)))
    throw InputError("expected a step longer than zero, found " + rounded_text(length_s) + " s");
  outputs();  // quaternions continue from the previous step
  run.advance(time_s + length_s, goes_on);
  outputs_are_new_ = false;
  outputs();
}

void FmuInstance::set(std::span<const Reference> references, std::span<const double> values) {
  if (references.size() != values.size())
    throw InputError("expected as many values as value references");
  const bool has_begun = mode_ == Mode::step;
  if (mode_ == Mode::terminated) require(Mode::step);
  for (std::size_t k = 0; k < values.size(); ++k) {
    const FmuVariable& each = variable(references[k]);
    if (!std::isfinite(values[k])) throw InputError(each.name + ": expected a finite value");
    if (each.causality == Causality::parameter) {
      if (has_begun)
        throw InputError(each.name + ": a parameter cannot be changed after initialization");
      *parameters_[references[k] - 1] = values[k];
      run_.reset();
    } else if (each.causality == Causality::input) {
      const std::size_t input = references[k] - first_input_;
      inputs_[input] = values[k];
      if (has_begun)
        run().set_input(input, values[k]);
      else
        run_.reset();  // its start depends on its inputs
    } else {
      throw InputError(each.name + ": cannot be set, since it is neither a parameter nor an input");
    }
    outputs_are_new_ = false;
  }
}

const std::vector<double>& FmuInstance::outputs() {
  if (outputs_are_new_) return outputs_;
  const multibody::History history = run().output();
  warnings_ = history.warnings;
  outputs_.clear();
  for (std::size_t k = 0; k < model_.channels.size(); ++k) {
    const ChannelSpec& spec = model_.channels[k];
    multibody::Channel channel = channel_of(history, spec, model_.model.gravity_m_s2);
    if (last_[k].size() > 0) continue_channel(spec.quantity, last_[k], channel.values);
    last_[k] = channel.values.col(0);
    outputs_.insert(outputs_.end(), last_[k].begin(), last_[k].end());
  }
  outputs_are_new_ = true;
  return outputs_;
}

void FmuInstance::get(std::span<const Reference> references, std::span<double> values) {
  if (references.size() != values.size())
    throw InputError("expected as many values as value references");
  for (std::size_t k = 0; k < values.size(); ++k) {
    const Reference reference = references[k];
    switch (variable(reference).causality) {
      case Causality::independent:
        values[k] = time_s();
        break;
      case Causality::parameter:
        values[k] = *parameters_[reference - 1];
        break;
      case Causality::input:
        values[k] = inputs_[reference - first_input_];
        break;
      case Causality::output:
        values[k] = outputs()[reference - first_output_];
        break;
    }
  }
}

std::vector<std::string> FmuInstance::new_warnings() {
  const std::size_t told = std::min(std::exchange(told_, warnings_.size()), warnings_.size());
  return {warnings_.begin() + static_cast<std::ptrdiff_t>(told), warnings_.end()};
}

FmuInstance::State FmuInstance::save() const {
  State state{.mode = mode_,
              .relative_tolerance = model_.solver.relative_tolerance,
              .values = {},
              .inputs = inputs_,
              .run = {},
              .last = last_};
  for (const double* const value : parameters_) state.values.push_back(*value);
  if (run_) state.run = run_->state();
  return state;
}

void FmuInstance::restore(const State& state) {
  if (state.values.size() != parameters_.size() || state.inputs.size() != inputs_.size() ||
      state.last.size() != last_.size())
    throw InputError("the state belongs to another model");
  bool same = model_.solver.relative_tolerance == state.relative_tolerance;
  model_.solver.relative_tolerance = state.relative_tolerance;
  mode_ = state.mode;
  for (std::size_t k = 0; k < parameters_.size(); ++k) {
    same = same && *parameters_[k] == state.values[k];
    *parameters_[k] = state.values[k];
  }
  inputs_ = state.inputs;
  if (!same || !state.run) run_.reset();
  if (state.run) run().restore(*state.run);
  last_ = state.last;
  outputs_are_new_ = false;
}

std::string FmuInstance::bytes_of(State& state, const std::string& token) {
  ByteWriter writer;
  archive(writer, state);
  return writer.bytes() + hash_of_text(token + writer.bytes());
}

FmuInstance::State FmuInstance::state_of(std::string_view bytes, const std::string& token) {
  const std::size_t hash_size = hash_of_text({}).size();
  const std::size_t size = bytes.size() - std::min(bytes.size(), hash_size);
  const std::string_view hash = bytes.substr(size);
  bytes = bytes.substr(0, size);
  if (hash_of_text(token + std::string(bytes)) != hash)
    throw InputError("the saved state is damaged, or belongs to another model");
  ByteReader reader(bytes);
  State state;
  archive(reader, state);
  reader.finish();
  return state;
}

}  // namespace flexneck::pipeline
