// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>

namespace flexneck {

/// Unusable input of the user: an argument, a study, a file. The text is one line that says where,
/// what was expected, what was found and what to do. The command exits with 2.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A computation on sound input failed. The command exits with 3.
class ComputationError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace flexneck
