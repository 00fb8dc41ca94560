// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <concepts>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

namespace flexneck::pipeline {

/// Source of a document's TOML: a file, or a text that stands for a file of this path and refers to
/// others relative to its folder. A path alone is a file.
struct DocumentSource {
  // Implicit, since a document usually is a file.
  template <std::convertible_to<std::filesystem::path> File>
  DocumentSource(const File& file) : path(file) {}
  DocumentSource(std::filesystem::path stands_for, std::string toml)
      : path(std::move(stands_for)), text(std::move(toml)) {}

  std::filesystem::path path;
  std::optional<std::string> text = std::nullopt;
};

}  // namespace flexneck::pipeline
