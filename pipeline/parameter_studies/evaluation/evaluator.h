// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "pipeline/language/study/study_reader.h"
#include "pipeline/parameter_studies/evaluation/body_cache.h"
#include "pipeline/parameter_studies/evaluation/output_name.h"
#include "pipeline/process/console.h"
#include "pipeline/run/remembered_study.h"

namespace flexneck::pipeline {

/// Outputs wanted of a study with changed values.
struct WantedOutputs {
  std::vector<OutputName> figures;
  std::vector<OutputName> curves;  ///< channels of pendulum cases
};

struct Evaluation {
  Eigen::VectorXd figures;  ///< SI; NaN for a figure that could not be read off its result
  std::string problem;      ///< reason of the first such figure; else empty
  /// Values at the output times of their cases, SI.
  std::vector<Eigen::VectorXd> curves;
  std::vector<Eigen::VectorXd> times_s;  ///< output times of each curve
};

/// Evaluates a study with changed values: runs only the stages that the wanted outputs need, and
/// computes meshes and modes once for all evaluations that share the values they depend on. Safe
/// for any number of threads; at most one in a process.
class Evaluator {
 public:
  /// @param base     the study and the settings common to all evaluations
  /// @param console  takes the messages of meshing; outlives this
  Evaluator(StudyChoice base, const Console& console);

  /// Finds the wanted names in the base study.
  /// @throws InputError for a name that the study does not have or produce: "output '…': …".
  WantedOutputs wanted(const std::vector<std::string>& figures,
                       const std::vector<std::string>& curves) const;

  /// Fails for outputs whose names are valid but that the base study does not produce, such as the
  /// frequency of a mode that is not computed; computes modes for that if it must.
  /// @throws InputError, or what computing them throws.
  void require_produced(const WantedOutputs& wanted);

  /// Computes the wanted outputs.
  /// @param settings  "key=value", in addition to the base study's
  /// @throws InputError or ComputationError for a study that is refused or cannot be computed.
  Evaluation evaluate(const std::vector<std::string>& settings, const WantedOutputs& wanted);

  /// Returns whether wanted outputs have derivatives in closed form: there is at least one figure,
  /// all figures are of the modes, and the parameters change nothing but the mesh.
  /// @param moved  settings with each parameter changed, in place of the others
  /// @throws InputError for a study that is refused.
  bool has_slopes(const std::vector<std::string>& settings,
                  const std::vector<std::vector<std::string>>& moved, const WantedOutputs& wanted);

  /// Computes these figures with their derivatives.
  /// @param moved  settings with each parameter changed, and the size of the change
  /// @pre has_slopes()
  /// @throws as evaluate() does, and InputError if a changed mesh has another topology.
  FigureSlopes slopes(const std::vector<std::string>& settings,
                      const std::vector<std::pair<std::vector<std::string>, double>>& moved,
                      const WantedOutputs& wanted);

  /// Reads the study with these settings. @throws as read_study() does.
  Study study(const std::vector<std::string>& settings);

  /// @throws InputError if the study's files have changed during use, so that evaluations are of
  /// different states of them.
  void require_same_study() const;

  /// Starts the mesher and the solver; call it before other threads begin.
  void start() { bodies_.start(); }
  const Study& base() const { return base_; }
  /// Number of modal analyses so far.
  std::size_t solved_count() const { return bodies_.solved_count(); }

 private:
  StudyChoice choice_;
  Study base_;
  BodyCache bodies_;
  mutable std::mutex mutex_;  ///< guards the readers
  bool has_study_changed_ = false;
  std::vector<std::unique_ptr<StudyReader>> idle_readers_;
};

/// SI unit of a curve.
std::string unit_of_curve(const OutputName& output);
/// SI unit of a figure. @throws InputError for a figure of another kind.
std::string unit_of(const OutputName& output, const Study& study);

}  // namespace flexneck::pipeline
