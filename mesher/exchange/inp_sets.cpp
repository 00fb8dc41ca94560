// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/exchange/inp_sets.h"

#include <algorithm>

#include "geometry/foundation/ascii.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"

namespace flexneck::mesher {
namespace {

constexpr std::size_t kMaxOfRanges = 10'000'000;  ///< numbers of one range
constexpr std::size_t kMaxInSets = 20'000'000;    ///< numbers of all sets if any has ranges: 160 MB

std::vector<std::int64_t> range_of(const InpData& line) {
  const std::int64_t first = inp_integer(line, 0);
  const std::int64_t last = line.fields.size() > 1 ? inp_integer(line, 1) : first;
  const std::int64_t step = line.fields.size() > 2 ? inp_integer(line, 2) : 1;
  constexpr auto kMost = static_cast<std::int64_t>(kMaxOfRanges);
  if (step < 1 || last < first || (last - first) / step > kMost) {
    throw InputError(line.place.text() +
                     "expected the first number, the last number and the increment of a range");
  }
  std::vector<std::int64_t> range;
  for (std::int64_t number = first; number <= last; number += step) range.push_back(number);
  return range;
}

}  // namespace

void add_to_inp_set(InpSets& sets, const std::string& name,
                    const std::vector<std::int64_t>& members) {
  InpSet& set = sets.try_emplace(upper_case(name), InpSet{name, {}, {}}).first->second;
  set.members.insert(set.members.end(), members.begin(), members.end());
  std::sort(set.members.begin(), set.members.end());
  set.members.erase(std::unique(set.members.begin(), set.members.end()), set.members.end());
}

bool is_inp_set(const InpData& line, std::size_t field, const InpSets& sets) {
  return field < line.fields.size() && sets.count(upper_case(line.fields[field])) > 0;
}

std::vector<std::int64_t> inp_members_of(const InpData& line, std::size_t field,
                                         const InpSets& sets, const std::string& kind) {
  if (field >= line.fields.size() || line.fields[field].empty()) {
    throw InputError(line.place.text() + "expected a number or an " + kind);
  }
  const std::string& text = line.fields[field];
  if (is_inp_set(line, field, sets)) return sets.at(upper_case(text)).members;
  if (is_digit(text.front())) return {inp_integer(line, field)};
  std::vector<std::string> names;
  for (const auto& [key, each] : sets) names.push_back(each.name);
  throw InputError(line.place.text() + "there is no " + kind + " '" + text + "'" +
                   did_you_mean(names, text));
}

void read_inp_set(const InpCard& card, const std::string& parameter, InpSets& sets) {
  const std::string& name = card.parameter(parameter);
  std::size_t all = 0;
  for (const auto& [key, set] : sets) all += set.members.size();
  std::vector<std::int64_t> members;
  std::vector<std::int64_t> written;
  for (const InpData& line : card.data) {
    if (card.has("GENERATE")) {
      const std::vector<std::int64_t> range = range_of(line);
      if (all + members.size() + range.size() > kMaxInSets) {
        throw InputError(line.place.text() + "expected at most " + std::to_string(kMaxInSets) +
                         " numbers in all sets, found more");
      }
      members.insert(members.end(), range.begin(), range.end());
      continue;
    }
    for (std::size_t f = 0; f < line.fields.size(); ++f) {
      const std::vector<std::int64_t> more = inp_members_of(line, f, sets, parameter);
      if (!is_inp_set(line, f, sets)) written.push_back(more.front());
      members.insert(members.end(), more.begin(), more.end());
    }
  }
  add_to_inp_set(sets, name, members);
  std::vector<std::int64_t>& known = sets.at(upper_case(name)).written;
  known.insert(known.end(), written.begin(), written.end());
}

}  // namespace flexneck::mesher
