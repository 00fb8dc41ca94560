// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace flexneck {

/// The candidate that a misspelt name most likely means; empty if none is near.
std::string nearest_name(const std::vector<std::string>& candidates, const std::string& name);

/// Text " (did you mean 'near'?)" for the end of a message; empty if no candidate is near.
std::string did_you_mean(const std::vector<std::string>& candidates, const std::string& name);

/// Position of a name in a list. `kind` says what is named, e.g. "marker".
/// @throws InputError if it is not there; the message gives the nearest name and lists all.
std::size_t find_name(const std::vector<std::string>& names, const std::string& name,
                      const std::string& kind);

/// Checks names that label groups of HDF5 files: refuses empty and repeated names and those with
/// '/' or unprintable characters (printable.h).
/// @throws InputError
void check_names(const std::vector<std::string>& names, const std::string& kind);

/// The names of a list of named things, in its order.
template <class Named>
std::vector<std::string> names_of(const std::vector<Named>& things) {
  std::vector<std::string> names;
  names.reserve(things.size());
  for (const Named& thing : things) names.push_back(thing.name);
  return names;
}

}  // namespace flexneck
