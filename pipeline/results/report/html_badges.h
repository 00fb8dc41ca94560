// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "geometry/foundation/provenance.h"

namespace flexneck::pipeline {

/// A framed word with a sign of its own, so that its meaning does not depend on colour.
/// @param kind  a class of page/report.css
std::string badge(const std::string& kind, const std::string& sign, const std::string& word);

std::string origin_badge(Origin origin);
std::string passed_badge();
std::string failed_badge();

}  // namespace flexneck::pipeline
