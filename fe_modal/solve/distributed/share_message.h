// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "fe_modal/solve/distributed/messages.h"
#include "fe_modal/solve/distributed/share.h"

namespace flexneck::fe_modal {

Bytes pack(const Share& share);
Share unpack_share(Bytes bytes);

}  // namespace flexneck::fe_modal
