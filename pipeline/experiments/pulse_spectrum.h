// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <complex>
#include <vector>

namespace flexneck::pipeline {

/// Fourier transform int a(t) exp(-2 pi i f t) dt in closed form of a function that is linear
/// between its samples and zero outside; at frequency 0 its integral.
/// @param times_s  strictly increasing, one per value
std::complex<double> fourier_transform(const std::vector<double>& times_s,
                                       const std::vector<double>& values, double frequency_Hz);

}  // namespace flexneck::pipeline
