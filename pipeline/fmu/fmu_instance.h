// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "multibody/simulation/stepped_run.h"
#include "pipeline/fmu/fmu_model.h"

namespace flexneck::pipeline {

/// An instance of an FMU for co-simulation, behind the functions of the standard. All members throw
/// InputError for what the importer may not do, ComputationError for a run that cannot go on.
class FmuInstance {
 public:
  using Reference = std::uint32_t;

  enum class Mode { instantiated, initialization, step, terminated };

  /// What an importer saves and restores.
  struct State {
    Mode mode = Mode::instantiated;
    double relative_tolerance = 0;
    std::vector<double> values, inputs;  ///< of parameters, of inputs
    std::optional<multibody::SteppedRun::State> run;
    std::vector<Eigen::VectorXd> last;  ///< of the channels, which quaternions go on from
  };

  explicit FmuInstance(FmuModel model);

  /// @throws InputError unless the run starts at that time.
  void begin_initialization(std::optional<double> relative_tolerance, double time_s);
  /// From then on parameters stay.
  void end_initialization();
  void terminate();
  void advance(double time_s, double length_s, const multibody::SteppedRun::GoesOn& goes_on = {});
  double time_s();

  void set(std::span<const Reference> references, std::span<const double> values);
  void get(std::span<const Reference> references, std::span<double> values);

  /// Sentences on what of the results is not to be trusted, of what was not told before.
  std::vector<std::string> new_warnings();

  State save() const;
  void restore(const State& state);
  /// The state's bytes, followed by their hash with the model's token.
  static std::string bytes_of(State& state, const std::string& token);
  /// @throws InputError for bytes that are damaged or of another model.
  static State state_of(std::string_view bytes, const std::string& token);

 private:
  void require(Mode needed) const;
  const FmuVariable& variable(Reference reference) const;
  multibody::SteppedRun& run();
  /// The values of all outputs at the present time.
  const std::vector<double>& outputs();

  FmuModel model_;
  std::vector<FmuVariable> variables_;
  std::vector<double*> parameters_;  ///< members of model_
  Reference first_input_ = 0, first_output_ = 0;
  Mode mode_ = Mode::instantiated;
  std::optional<multibody::SteppedRun> run_;
  std::vector<double> inputs_;
  std::vector<Eigen::VectorXd> last_;
  std::vector<double> outputs_;
  bool outputs_are_new_ = false;
  std::vector<std::string> warnings_;  ///< of the run until now
  std::size_t told_ = 0;               ///< how many of them
};

}  // namespace flexneck::pipeline
