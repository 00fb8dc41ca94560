// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/exchange/left_out.h"

#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"

namespace flexneck::mesher {

void LeftOut::add(const std::string& kind, std::size_t count) {
  if (count > 0) counts_[kind] += count;
}

void LeftOut::add_to_structure(const std::string& kind, const std::string& place) {
  Kind& all = of_structure_[kind];
  if (all.count++ == 0) all.first = place;
}

void LeftOut::require_named(const std::vector<std::string>& named) {
  for (const std::string& name : named) {
    const auto found = of_structure_.find(name);
    if (found == of_structure_.end()) {
      std::vector<std::string> known;
      for (const auto& [kind, all] : of_structure_) known.push_back(kind);
      throw InputError("geometry.leave_out names '" + name +
                       "', but the file has no unsupported cards of that kind" +
                       did_you_mean(known, name));
    }
    add(name, found->second.count);
    of_structure_.erase(found);
  }
  if (of_structure_.empty()) return;
  std::string text;
  for (const auto& [kind, all] : of_structure_) {
    text += (text.empty() ? "" : ", ") + std::to_string(all.count) + " " + kind + " (first in " +
            all.first + ")";
  }
  throw InputError("the file has unsupported cards that change the structure: " + text +
                   "; remove them, or list their kinds in geometry.leave_out to ignore them");
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
