// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "geometry/foundation/error.h"
#include "geometry/foundation/temporary_folder.h"

namespace flexneck::fuzz {

/// A folder for the files that a target reads; in memory if TMPDIR is.
class InputFolder {
 public:
  /// Writes a file of that name with these contents and returns its path.
  std::filesystem::path with(const std::string& name, const std::string& contents) const;
  const std::filesystem::path& path() const { return folder_.path(); }

 private:
  TemporaryFolder folder_;
};

/// Ends the process with the sentence and the stack if the condition fails: this is a finding.
void require(bool holds, const std::string& what);

inline std::string text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// Runs a reader. It may refuse its input by an InputError with a text. Any other exception passes,
/// and is a finding.
template <class Read>
int try_reader(const Read& read) {
  try {
    read();
  } catch (const InputError& error) {
    require(*error.what() != '\0', "a refusal says why");
  }
  return 0;
}

}  // namespace flexneck::fuzz
