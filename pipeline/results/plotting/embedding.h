// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>

namespace flexneck::pipeline {

/// Escapes text for HTML, between tags or in a quoted attribute. Unprintable characters are spelt
/// out.
std::string html_text(std::string_view text);

/// JSON for a <script> of type application/json: nothing in it can end the element, and bytes that
/// are not UTF-8 are replaced.
std::string script_json(const nlohmann::ordered_json& json);

/// JavaScript for a <script>: text that would end the element is escaped within its strings.
std::string script_source(std::string source);

std::string base64(std::span<const std::byte> bytes);

/// Numbers for the page's typed arrays: their bytes, little-endian.
template <class Number>
std::string base64_of(const std::vector<Number>& numbers) {
  return base64(std::as_bytes(std::span(numbers)));
}

/// A matrix as 32-bit floats, column by column.
std::string base64_floats(const Eigen::Ref<const Eigen::MatrixXd>& values);

/// A template with each {{name}} replaced once; inserted texts are not searched again.
/// @throws std::logic_error for a name without a text, when template and program differ.
std::string filled(std::string_view page, const std::map<std::string, std::string>& texts);

}  // namespace flexneck::pipeline
