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
                "Fractional Zener model 1 - share / (1 + (i w time)^order): fraction of the "
                "stiffness that relaxes",
                {.range = {.low = 0, .high = 1, .has_low = false}}),
    Key::quantity("time", "s", kNone, "Relaxation time of the fractional Zener model",
                  {.range = kPositive}),
    Key::number("order", kNone,
                "Order of the fractional Zener model; with order 1 it is a single Maxwell branch",
                {.range = {.low = 0, .high = 1, .has_low = false}}),
    Key::quantity("from", "Hz", kNone,
                  "Lowest frequency at which the branches are fitted to the law",
                  {.range = kPositive}),
    Key::quantity("to", "Hz", kNone,
                  "Highest frequency at which the branches are fitted to the law",
                  {.range = kPositive}),
    Key::quantities("frequencies", "Hz", kNone, "Frequencies of a measured dynamic modulus"),
    Key::quantities("storage", "Pa", kNone, "Storage modulus at each frequency"),
    Key::quantities("loss", "Pa", kNone, "Loss modulus at each frequency"),
    Key::quantities("times", "s", kNone, "Times of a measured relaxation, after a sudden strain"),
    Key::quantities("moduli", "Pa", kNone, "Relaxation modulus at each time"),
    Key::quantity("modulus", "Pa", kNone,
                  "Modulus to which the section's stiffness corresponds, for motions faster than "
                  "all of the measured table",
                  {.range = kPositive}),
    Key::count("branches", "4",
               "Number of Maxwell branches; branches whose share becomes zero are omitted",
               {.range = {.low = 1, .high = 20}}),
    Key::number("largest_error", "0.05",
                "Largest allowed error of the fit, as a fraction of the modulus",
                {.range = {.low = 0, .high = 1, .has_low = false}}),
});

/// Reads branches by the keys kRelaxationLawKeys, and the quality of their fit to the law.
/// @throws InputError at an invalid key, and for branches that miss the law by more than is allowed
Relaxation read_relaxation_law(const StudyTable& law);

}  // namespace flexneck::pipeline
