// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace flexneck::mesher {

/// Collects content of a file that the mesh cannot hold, by kind and number. Loads and the like are
/// reported to the user in one line; content that changes the structure, such as rigid elements, is
/// refused unless the user has named it.
class LeftOut {
 public:
  void add(const std::string& kind, std::size_t count = 1);
  /// Adds a remark in words, without a number.
  void remark(const std::string& text) { remarks_.push_back(text); }
  /// Adds content whose omission changes the structure.
  /// @param place of the first item, for the message: "line 7"
  void add_to_structure(const std::string& kind, const std::string& place);

  /// Checks that the user has agreed to every omission that changes the structure.
  /// @param named kinds that the user agrees to leave out
  /// @throws InputError for kinds that change the structure and are not named, with their numbers
  /// and the place of the first; for names of kinds that do not occur.
  void require_named(const std::vector<std::string>& named);

  bool empty() const { return counts_.empty() && remarks_.empty() && of_structure_.empty(); }
  /// Text such as "not carried over: 3 FORCE, 2 SPC1; a remark", kinds in alphabetical order, at
  /// most 30.
  std::string text() const;

 private:
  struct Kind {
    std::size_t count = 0;
    std::string first;
  };
  std::map<std::string, std::size_t> counts_;
  std::map<std::string, Kind> of_structure_;
  std::vector<std::string> remarks_;
};

}  // namespace flexneck::mesher
