// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <complex>
#include <vector>

namespace flexneck::pipeline {

/// Fourier transform int a(t) exp(-2 pi i f t) dt of a function that is linear between its rows and
/// zero outside, in closed form; at frequency 0 its integral.
/// @param times_s  strictly increasing, one value for each
std::complex<double> fourier_transform(const std::vector<double>& times_s,
                                       const std::vector<double>& values, double frequency_Hz);

}  // namespace flexneck::pipeline
