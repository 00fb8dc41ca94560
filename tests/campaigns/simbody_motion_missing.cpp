// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/campaigns/mechanism.h"

namespace flexneck::campaigns {

std::optional<Motion> simbody_motion(const Mechanism& /*mechanism*/) { return std::nullopt; }

}  // namespace flexneck::campaigns
