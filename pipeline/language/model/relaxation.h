// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "multibody/forces/section.h"
#include "pipeline/language/document/study_document.h"
#include "pipeline/language/model/relaxation_law.h"

namespace flexneck::pipeline {

/// Maxwell branches of a [[section]]: for each, its relaxation time and the fraction of the
/// stiffness that relaxes with it.
struct Relaxation {
  std::vector<double> times_s, shares;
  std::string fit;  ///< data of their fit, and its quality; empty if they were given
  /// Frequency range in which, by the study, they represent the rubber, Hz.
  std::optional<std::pair<double, double>> band_Hz;

  double sum_of_shares() const;
  /// Splits the section's stiffness, the instantaneous one, into the long-term one and branches.
  /// @param relaxing  the part of it that relaxes
  void apply(const multibody::Section::Stiffness& relaxing, multibody::Section& section) const;
};

/// Keys of the temperature shift: Williams, Landel and Ferry, J. Am. Chem. Soc. 77 (1955) 3701.
inline constexpr Key kShiftKeys[] = {
    Key::quantity("temperature", "K", kRequired, "Temperature of the rubber"),
    Key::quantity("reference", "K", kRequired, "Temperature at which the relaxation times hold"),
    Key::number("c1", kRequired,
                "Relaxation times are multiplied by 10^(-c1 d / (c2 + d)), d being "
                "what the temperature is above the reference"),
    Key::quantity("c2", "K", kRequired, "See c1", {.range = kPositive}),
    Key::quantity("from", "K", kRequired, "Lowest temperature at which c1 and c2 were measured"),
    Key::quantity("to", "K", kRequired, "Highest temperature, likewise"),
};

inline constexpr auto kRelaxationKeys = std::to_array<Key>({
    Key::quantities("relaxation_times", "s", kNone, "Relaxation times of Maxwell branches"),
    Key::numbers("relaxation_shares", kNone,
                 "Of each branch, the share of the stiffness that it takes with it; their sum is "
                 "at most one, and with slow_modes_file they share what that lacks"),
    Key::table("relaxation_law",
               "In place of relaxation_times and relaxation_shares: a law that they are fitted to",
               kRelaxationLawKeys),
    Key::quantities("relaxation_band", "Hz", kNone,
                    "Lowest and highest frequency at which the branches stand for the rubber, for "
                    "the report",
                    {.size = 2}),
    Key::table("shift", "How temperature shifts the relaxation times", kShiftKeys),
});

/// Reads the keys kRelaxationKeys. @throws InputError at an invalid key, and for a temperature
/// outside of the shift's range
Relaxation read_relaxation(const StudyTable& section);

}  // namespace flexneck::pipeline
