// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/results/plotting/embedding.h"

#include <bit>
#include <stdexcept>

#include <nlohmann/json.hpp>

#include "geometry/foundation/error.h"
#include "geometry/foundation/printable.h"
#include "geometry/foundation/xml_text.h"

namespace flexneck::pipeline {

static_assert(std::endian::native == std::endian::little, "typed arrays are written as they lie");

namespace {

void replace_all(std::string& text, std::string_view from, std::string_view to) {
  for (std::size_t at = text.find(from); at != std::string::npos;
       at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
}

}  // namespace

std::string html_text(std::string_view text) { return xml_text(printable(text, "\n")); }

std::string script_json(const nlohmann::ordered_json& json) {
  using Json = nlohmann::ordered_json;
  std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  replace_all(text, "<", "\\u003c");
  return text;
}

std::string script_source(std::string source) {
  replace_all(source, "</script", "<\\/script");
  replace_all(source, "<!--", "<\\!--");
  return source;
}

std::string base64(std::span<const std::byte> bytes) {
  static constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group = group << 8U | (k < count ? std::to_integer<std::uint32_t>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += k <= count ? kDigits[group >> (18 - 6 * k) & 63U] : '=';
    }
  }
  return text;
}

std::string base64_floats(const Eigen::Ref<const Eigen::MatrixXd>& values) {
  std::vector<float> floats;
  floats.reserve(static_cast<std::size_t>(values.size()));
  for (Eigen::Index c = 0; c < values.cols(); ++c) {
    for (Eigen::Index r = 0; r < values.rows(); ++r) {
      floats.push_back(static_cast<float>(values(r, c)));
    }
  }
  return base64_of(floats);
}

std::string filled(std::string_view page, const std::map<std::string, std::string>& texts) {
  std::string result;
  while (true) {
    const std::size_t begin = page.find("{{");
    result += page.substr(0, begin);
    if (begin == std::string_view::npos) return result;
    const std::size_t end = page.find("}}", begin);
    const std::string name(page.substr(begin + 2, end - begin - 2));
    const auto text = texts.find(name);
    if (end == std::string_view::npos || text == texts.end()) {
      throw std::logic_error("the page asks for '" + name + "', which the report has not");
    }
    result += text->second;
    page.remove_prefix(end + 2);
  }
}

}  // namespace flexneck::pipeline
