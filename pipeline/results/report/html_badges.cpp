// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/results/report/html_badges.h"

#include <array>

namespace flexneck::pipeline {

std::string badge(const std::string& kind, const std::string& sign, const std::string& word) {
  return "<span class=\"badge " + kind + "\"><span aria-hidden=\"true\">" + sign + "</span> " +
         word + "</span>";
}

std::string origin_badge(Origin origin) {
  static constexpr std::array<const char*, 4> kSigns = {"■", "◇", "◆", "○"};
  const std::string name(name_of(origin));
  return badge(name, kSigns[static_cast<std::size_t>(origin)], name);
}

std::string passed_badge() { return badge("passed", "✓", "pass"); }
std::string failed_badge() { return badge("failed", "✗", "FAIL"); }

}  // namespace flexneck::pipeline
