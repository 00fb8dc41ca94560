// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/equations/kink.h"

#include <algorithm>

namespace flexneck::multibody {

std::string kink_between(const ForceSet& forces, const RatesAndPieces& ahead,
                         const Eigen::VectorXd& at_state, const RatesAndPieces& behind) {
  // Smooth loads differ by the differences' extent, 1e-5, relative to their slope.
  constexpr double kSmooth = 1e-3;
  const auto differing =
      std::mismatch(ahead.pieces.begin(), ahead.pieces.end(), behind.pieces.begin()).first;
  if (differing == ahead.pieces.end()) return {};
  const double bend = (ahead.rates - 2 * at_state + behind.rates).norm();
  if (!(bend > kSmooth * (ahead.rates - behind.rates).norm())) return {};
  return forces.name_of_piece(static_cast<std::size_t>(differing - ahead.pieces.begin()));
}

}  // namespace flexneck::multibody
