// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/foundation/names.h"

#include <algorithm>
#include <numeric>
#include <set>

#include "geometry/foundation/error.h"
#include "geometry/foundation/printable.h"

namespace flexneck {
namespace {

/// Levenshtein distance: insertions, deletions and replacements that turn a into b.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

std::string nearest_name(const std::vector<std::string>& candidates, const std::string& name) {
  const auto best = std::min_element(
      candidates.begin(), candidates.end(), [&](const std::string& left, const std::string& right) {
        return edit_distance(left, name) < edit_distance(right, name);
      });
  // A name with more than a third of its letters wrong is another word, not a misspelling.
  if (best == candidates.end() || 3 * edit_distance(*best, name) > name.size() + 2) return {};
  return *best;
}

std::string did_you_mean(const std::vector<std::string>& candidates, const std::string& name) {
  const std::string near = nearest_name(candidates, name);
  return near.empty() ? near : " (did you mean '" + near + "'?)";
}

std::size_t find_name(const std::vector<std::string>& names, const std::string& name,
                      const std::string& kind) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  std::string message = "there is no " + kind + " '" + name + "'" + did_you_mean(names, name);
  if (names.empty()) throw InputError(message + "; none are defined");
  message += "; there are:";
  for (const std::string& each : names) message += " '" + each + "'";
  throw InputError(message);
}

void check_names(const std::vector<std::string>& names, const std::string& kind) {
  std::set<std::string> seen;
  for (std::size_t k = 0; k < names.size(); ++k) {
    const std::string& name = names[k];
    if (name.empty()) {
      throw InputError(kind + " " + std::to_string(k + 1) + " has no name; give it one");
    }
    if (find_unprintable(name) != std::string::npos) {
      throw InputError(kind + " '" + printable(name) +
                       "': a name must not contain control characters; choose another");
    }
    if (name.find('/') != std::string::npos) {
      throw InputError(kind + " '" + name + "': a name must not contain '/'; choose another");
    }
    if (!seen.insert(name).second) {
      throw InputError(kind + " '" + name + "' occurs twice; names must differ");
    }
  }
}

}  // namespace flexneck
