// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/exchange/left_out.h"

namespace flexneck::mesher {

void LeftOut::add(const std::string& kind, std::size_t count) {
  if (count > 0) counts_[kind] += count;
}

std::string LeftOut::text() const {
  constexpr std::size_t kMaxKinds = 30;
  std::string text;
  std::size_t kinds = 0;
  for (const auto& [kind, count] : counts_) {
    if (kinds++ == kMaxKinds) {
      text += ", " + std::to_string(counts_.size() - kMaxKinds) + " more kinds";
      break;
    }
    text += (text.empty() ? "not carried over: " : ", ") + std::to_string(count) + " " + kind;
  }
  for (const std::string& remark : remarks_) text += (text.empty() ? "" : "; ") + remark;
  return text;
}

}  // namespace flexneck::mesher
