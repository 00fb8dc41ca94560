// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace flexneck::mesher {

/// Collects what a file gives and the mesh cannot hold, by kind and number. Loads and the
/// like are told to the user in one line; what changes the structure, such as rigid elements, is
/// refused unless the user has named it.
class LeftOut {
 public:
  void add(const std::string& kind, std::size_t count = 1);
  /// Something that is said in words, without a number.
  void remark(const std::string& text) { remarks_.push_back(text); }
  /// Something without which the structure is another one.
  /// @param place of the first, for the message: "line 7"
  void add_to_structure(const std::string& kind, const std::string& place);

  /// @param named kinds that the user does without
  /// @throws InputError for kinds that change the structure and are not named, with their numbers
  /// and where the first is; for names of which there is nothing.
  void require_named(const std::vector<std::string>& named);

  bool empty() const { return counts_.empty() && remarks_.empty() && of_structure_.empty(); }
  /// "not carried over: 3 FORCE, 2 SPC1; a remark", kinds in alphabetical order, at most 30.
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
