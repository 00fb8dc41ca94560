// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

namespace flexneck::testing {

/// Samples in the second implementation, which shares nothing with the one that it checks.
using Samples = std::vector<double>;

struct PlainIso18571 {
  double corridor, phase, magnitude, slope, overall;
  int shift;
};

/// ISO/TS 18571 by its definition, with every sum written out: each correlation with its own means,
/// the whole matrix of the warping, its path traced back from the end. Work n^2, memory n^2.
PlainIso18571 plain_iso18571(const Samples& reference, const Samples& computed);

struct PlainCora {
  double corridor, progression, size, phase, overall;
  int shift;
};

/// CORA with its default parameters, on the whole of the curves.
PlainCora plain_cora(const Samples& reference, const Samples& computed);

}  // namespace flexneck::testing
