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
    Key::quantity("reference", "K", kRequired, "Reference temperature of the relaxation times"),
    Key::number("c1", kRequired,
                "Constant of the WLF shift: relaxation times are multiplied by 10^(-c1 d / (c2 + "
                "d)), with the temperature difference d to the reference"),
    Key::quantity("c2", "K", kRequired, "See c1", {.range = kPositive}),
    Key::quantity("from", "K", kRequired, "Lowest temperature at which c1 and c2 were measured"),
    Key::quantity("to", "K", kRequired, "Highest temperature at which c1 and c2 were measured"),
};

inline constexpr auto kRelaxationKeys = std::to_array<Key>({
    Key::quantities("relaxation_times", "s", kNone, "Relaxation times of the Maxwell branches"),
    Key::numbers("relaxation_shares", kNone,
                 "Fraction of the stiffness of each branch; the sum is at most one; with "
                 "slow_modes_file, fractions of the difference of the two stiffnesses"),
    Key::table("relaxation_law",
               "Instead of relaxation_times and relaxation_shares: a relaxation law to which they "
               "are fitted",
               kRelaxationLawKeys),
    Key::quantities(
        "relaxation_band", "Hz", kNone,
        "Lowest and highest frequency at which the branches represent the rubber, for the report",
        {.size = 2}),
    Key::table("shift", "Shift of the relaxation times with temperature", kShiftKeys),
});

/// Reads the keys kRelaxationKeys. @throws InputError at an invalid key, and for a temperature
/// outside of the shift's range
Relaxation read_relaxation(const StudyTable& section);

}  // namespace flexneck::pipeline
