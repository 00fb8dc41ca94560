// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "multibody/simulation/stepped_run.h"
#include "pipeline/exchange/fmu/fmu_model.h"

namespace flexneck::pipeline {

/// An instance of an FMU for co-simulation, behind the functions of the standard. All members throw
/// InputError for calls that the importer may not make, ComputationError for a run that cannot
/// continue.
class FmuInstance {
 public:
  using Reference = std::uint32_t;

  enum class Mode { instantiated, initialization, step, terminated };

  /// State that an importer saves and restores.
  struct State {
    Mode mode = Mode::instantiated;
    double relative_tolerance = 0;
    std::vector<double> values, inputs;  ///< values of the parameters, of the inputs
    std::optional<multibody::SteppedRun::State> run;
    /// Last values of the channels, from which quaternions continue.
    std::vector<Eigen::VectorXd> last;
  };

  explicit FmuInstance(FmuModel model);

  /// Starts the initialization.
  /// @throws InputError unless the run starts at that time.
  void begin_initialization(std::optional<double> relative_tolerance, double time_s);
  /// Ends the initialization; parameters are constant from then on.
  void end_initialization();
  void terminate();
  void advance(double time_s, double length_s, const multibody::SteppedRun::GoesOn& goes_on = {});
  double time_s();

  void set(std::span<const Reference> references, std::span<const double> values);
  void get(std::span<const Reference> references, std::span<double> values);

  /// New warnings about results, each returned once.
  std::vector<std::string> new_warnings();

  State save() const;
  void restore(const State& state);
  /// Bytes of the state, followed by their hash with the model's token.
  static std::string bytes_of(State& state, const std::string& token);
  /// Reads a state. @throws InputError for bytes that are damaged or of another model.
  static State state_of(std::string_view bytes, const std::string& token);

 private:
  void require(Mode needed) const;
  const FmuVariable& variable(Reference reference) const;
  multibody::SteppedRun& run();
  /// Values of all outputs at the current time.
  const std::vector<double>& outputs();

  FmuModel model_;
  std::vector<FmuVariable> variables_;
  std::vector<double*> parameters_;  ///< pointers to members of model_
  Reference first_input_ = 0, first_output_ = 0;
  Mode mode_ = Mode::instantiated;
  std::optional<multibody::SteppedRun> run_;
  std::vector<double> inputs_;
  std::vector<Eigen::VectorXd> last_;
  std::vector<double> outputs_;
  bool outputs_are_new_ = false;
  std::vector<std::string> warnings_;  ///< warnings of the run so far
  std::size_t told_ = 0;               ///< number of warnings already returned
};

}  // namespace flexneck::pipeline
