// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace flexneck::mesher {

/// What a file gives beside the mesh and the mesh cannot hold, by kind and number: masses, springs,
/// supports, loads. One line tells the user of all of it.
class LeftOut {
 public:
  void add(const std::string& kind, std::size_t count = 1);
  /// Something that is said in words, without a number.
  void remark(const std::string& text) { remarks_.push_back(text); }

  bool empty() const { return counts_.empty() && remarks_.empty(); }
  /// "not carried over: 3 CONM2, 2 SPC1; a remark", kinds in alphabetical order, at most 30.
  std::string text() const;

 private:
  std::map<std::string, std::size_t> counts_;
  std::vector<std::string> remarks_;
};

}  // namespace flexneck::mesher
