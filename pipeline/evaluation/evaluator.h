// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "pipeline/console/console.h"
#include "pipeline/evaluation/body_cache.h"
#include "pipeline/evaluation/output_name.h"
#include "pipeline/folder/remembered_study.h"
#include "pipeline/study/study_reader.h"

namespace flexneck::pipeline {

/// What is wanted of a study with other values.
struct WantedOutputs {
  std::vector<OutputName> figures;
  std::vector<OutputName> curves;  ///< channels of pendulum cases
};

struct Evaluation {
  Eigen::VectorXd figures;  ///< SI; NaN of one that could not be read off its result
  std::string problem;      ///< of the first of these; else empty
  /// At the outputs of their cases, SI.
  std::vector<Eigen::VectorXd> curves;
  std::vector<Eigen::VectorXd> times_s;  ///< of each curve
};

/// Evaluates a study with other values: only the stages that the wanted outputs need, and meshes
/// and modes once for all evaluations that share the values they are made from. For any number of
/// threads; one at a time in a process.
class Evaluator {
 public:
  /// @param base     the study and the settings that hold every time
  /// @param console  for what meshing tells; outlives this
  Evaluator(StudyChoice base, const Console& console);

  /// The names of what is wanted, found in the base study.
  /// @throws InputError for a name of nothing that the study has or gives: "output '…': …".
  WantedOutputs wanted(const std::vector<std::string>& figures,
                       const std::vector<std::string>& curves) const;

  /// Refuses what the base study does not produce though its name is right, such as the frequency
  /// of a mode that is not among those computed; computes modes for that if it must.
  /// @throws InputError, or what computing them throws.
  void require_produced(const WantedOutputs& wanted);

  /// @param settings  "key=value", besides those of the base study
  /// @throws InputError or ComputationError for a study that is refused or cannot be computed.
  Evaluation evaluate(const std::vector<std::string>& settings, const WantedOutputs& wanted);

  /// Whether wanted outputs have derivatives in closed form: one figure or more, all of the modes,
  /// by what changes nothing but the mesh.
  /// @param moved  settings in the place of the others
  /// @throws InputError for a study that is refused.
  bool has_slopes(const std::vector<std::string>& settings,
                  const std::vector<std::vector<std::string>>& moved, const WantedOutputs& wanted);

  /// These figures with their derivatives.
  /// @param moved  by how much the number is moved in other settings
  /// @pre has_slopes()
  /// @throws as evaluate() does, and InputError where a mesh of another topology comes out.
  FigureSlopes slopes(const std::vector<std::string>& settings,
                      const std::vector<std::pair<std::vector<std::string>, double>>& moved,
                      const WantedOutputs& wanted);

  /// The study with these settings. @throws as read_study() does.
  Study study(const std::vector<std::string>& settings);

  /// @throws InputError if the study's files have changed while this was in use: some evaluations
  /// are of one state of them, some of another.
  void require_same_study() const;

  /// Starts what meshes and solves: before other threads begin.
  void start() { bodies_.start(); }
  const Study& base() const { return base_; }
  /// How often modes were computed.
  std::size_t solved_count() const { return bodies_.solved_count(); }

 private:
  StudyChoice choice_;
  Study base_;
  BodyCache bodies_;
  mutable std::mutex mutex_;  ///< of the readers
  bool has_study_changed_ = false;
  std::vector<std::unique_ptr<StudyReader>> idle_readers_;
};

/// The unit of a curve, SI.
std::string unit_of_curve(const OutputName& output);
/// The unit of a figure, SI. @throws InputError for a figure of another kind.
std::string unit_of(const OutputName& output, const Study& study);

}  // namespace flexneck::pipeline
