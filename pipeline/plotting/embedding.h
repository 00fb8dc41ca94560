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

/// Text for HTML, between tags or in an attribute in quotes. What is unprintable is spelt out.
std::string html_text(std::string_view text);

/// JSON for a <script> of type application/json: nothing in it can end the element, and bytes that
/// are not UTF-8 are replaced.
std::string script_json(const nlohmann::ordered_json& json);

/// JavaScript for a <script>: what would end the element is spelt otherwise within its texts.
std::string script_source(std::string source);

std::string base64(std::span<const std::byte> bytes);

/// Numbers as the page's typed arrays take them: their bytes, the lowest first.
template <class Number>
std::string base64_of(const std::vector<Number>& numbers) {
  return base64(std::as_bytes(std::span(numbers)));
}

/// A matrix as 32-bit floats, column by column.
std::string base64_floats(const Eigen::Ref<const Eigen::MatrixXd>& values);

/// A template with each {{name}} replaced once; what is put in is not searched again.
/// @throws std::logic_error for a name without a text: the template and the program differ.
std::string filled(std::string_view page, const std::map<std::string, std::string>& texts);

}  // namespace flexneck::pipeline
