// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/equations/kink.h"

#include <algorithm>
#include <utility>

namespace flexneck::multibody {

OpenSlits::OpenSlits(std::string name, const ModalSprings& springs, const Eigen::VectorXd& a)
    : body(std::move(name)) {
  for (const double opening_m : springs.gaps.openings_m(a - springs.offset))
    open.push_back(opening_m > 0);
}

std::string kink_between(const ForceSet& forces, const RatesAndPieces& ahead,
                         const Eigen::VectorXd& at_state, const RatesAndPieces& behind) {
  // Smooth loads differ relative to their slope by the extent of the differences, 1e-5.
  constexpr double kSmooth = 1e-3;
  const auto piece = std::ranges::mismatch(ahead.pieces, behind.pieces).in1;
  const auto slits = std::ranges::mismatch(ahead.slits, behind.slits).in1;
  const bool on_one_piece = piece == ahead.pieces.end();
  if (on_one_piece && slits == ahead.slits.end()) return {};
  const double bend = (ahead.rates - 2 * at_state + behind.rates).norm();
  if (!(bend > kSmooth * (ahead.rates - behind.rates).norm())) return {};
  if (on_one_piece) return "body '" + slits->body + "': a slit opens or closes";
  return forces.name_of_piece(static_cast<std::size_t>(piece - ahead.pieces.begin()));
}

}  // namespace flexneck::multibody
