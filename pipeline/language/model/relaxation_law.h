// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <complex>

#include "pipeline/language/document/study_document.h"

namespace flexneck::pipeline {

struct Relaxation;

/// Complex modulus at a frequency over the instantaneous modulus, for Maxwell branches.
std::complex<double> modulus_ratio(const Relaxation& branches, double frequency_Hz);
/// Modulus at a time after a sudden strain over the instantaneous modulus, for Maxwell branches.
double relaxed_ratio(const Relaxation& branches, double time_s);

/// The fractional Zener model over its instantaneous modulus: 1 - share / (1 + (i w tau)^order).
std::complex<double> fractional_ratio(double share, double time_s, double order,
                                      double frequency_Hz);

/// Keys of a relaxation law to which branches are fitted by least squares, with nonnegative shares
/// and relaxation times spaced evenly by their logarithm over those of the law.
inline constexpr auto kRelaxationLawKeys = std::to_array<Key>({
    Key::number("share", kNone,
                "Of a fractional Zener model 1 - share / (1 + (i w time)^order): the share of the "
                "stiffness that relaxes",
                {.range = {.low = 0, .high = 1, .has_low = false}}),
    Key::quantity("time", "s", kNone, "Its relaxation time", {.range = kPositive}),
    Key::number("order", kNone, "Its order; of one it is a Maxwell branch",
                {.range = {.low = 0, .high = 1, .has_low = false}}),
    Key::quantity("from", "Hz", kNone, "Lowest frequency at which branches shall follow it",
                  {.range = kPositive}),
    Key::quantity("to", "Hz", kNone, "Highest frequency, likewise", {.range = kPositive}),
    Key::quantities("frequencies", "Hz", kNone, "Of a measured dynamic modulus: its frequencies"),
    Key::quantities("storage", "Pa", kNone, "Storage modulus at each of frequencies"),
    Key::quantities("loss", "Pa", kNone, "Loss modulus at each of frequencies"),
    Key::quantities("times", "s", kNone, "Of a measured relaxation: times after a sudden strain"),
    Key::quantities("moduli", "Pa", kNone, "Modulus at each of times"),
    Key::quantity(
        "modulus", "Pa", kNone,
        "Of a table: the modulus of its kind that the section's stiffness belongs to, that of "
        "motions quicker than all of the table",
        {.range = kPositive}),
    Key::count("branches", "4", "Number of Maxwell branches; a share of zero leaves one out",
               {.range = {.low = 1, .high = 20}}),
    Key::number("largest_error", "0.05",
                "By which share of the modulus branches may miss the law at most",
                {.range = {.low = 0, .high = 1, .has_low = false}}),
});

/// Reads branches by the keys kRelaxationLawKeys, and the quality of their fit to the law.
/// @throws InputError at an invalid key, and for branches that miss the law by more than is allowed
Relaxation read_relaxation_law(const StudyTable& law);

}  // namespace flexneck::pipeline
