// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "pipeline/language/study/study.h"
#include "tests/support/beam_body.h"

namespace flexneck::testing {

/// The built-in study with the modes of a beam in place of the neck.
struct BeamExperiment {
  pipeline::Study study;
  fe_modal::ModalBody body = make_beam_body(Beam());

  /// @param settings  further settings of the study; the neck has all modes of the beam unless they
  /// differ
  explicit BeamExperiment(std::vector<std::string> settings = {}) {
    settings.insert(settings.begin(), R"(body.neck.modes=["all"])");
    study = pipeline::read_study(pipeline::built_in_study(), settings);
    const fe_modal::Interface& top = body.interface("top");
    for (Eigen::Index k = 0; k < body.mode_count(); ++k) {
      const bool fore_aft = std::abs(top.translation(0, k)) > std::abs(top.translation(1, k));
      body.modes[static_cast<std::size_t>(k)].shares_percent = {fore_aft ? 100.0 : 0,
                                                                fore_aft ? 0 : 100.0, 0, 0};
    }
  }
  const pipeline::CaseSection& named(const std::string& name) const {
    for (const pipeline::CaseSection& each : study.cases) {
      if (each.name == name) return each;
    }
    throw std::runtime_error("no case " + name);
  }
};

}  // namespace flexneck::testing
