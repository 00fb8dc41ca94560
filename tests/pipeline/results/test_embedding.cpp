// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstring>
#include <stdexcept>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "pipeline/results/plotting/embedding.h"
#include "pipeline/results/report/html_table.h"

using namespace flexneck;
using namespace flexneck::pipeline;
using Catch::Matchers::Contains;

namespace {

std::string base64_of_text(const std::string& text) {
  return base64(std::as_bytes(std::span(text)));
}

}  // namespace

TEST_CASE("base64 has the values of RFC 4648 section 10") {
  CHECK(base64_of_text("").empty());
  CHECK(base64_of_text("f") == "Zg==");
  CHECK(base64_of_text("fo") == "Zm8=");
  CHECK(base64_of_text("foo") == "Zm9v");
  CHECK(base64_of_text("foob") == "Zm9vYg==");
  CHECK(base64_of_text("fooba") == "Zm9vYmE=");
  CHECK(base64_of_text("foobar") == "Zm9vYmFy");
  CHECK(base64_of_text("\xfb\xff\xbf") == "+/+/");
}

TEST_CASE("a matrix goes into the page as its floats, column by column") {
  Eigen::MatrixXd values(2, 2);
  values << 1, 3, 2, 4;
  CHECK(base64_floats(values) == base64_of(std::vector<float>{1, 2, 3, 4}));
}

TEST_CASE("texts cannot become markup, nor end a script") {
  CHECK(html_text("<b title=\"a\">Tom & 'Jerry'</b>") ==
        "&lt;b title=&quot;a&quot;&gt;Tom &amp; &#39;Jerry&#39;&lt;/b&gt;");
  CHECK(html_text("a\x1b[2J\xff") == "a\\x1b[2J\\xff");
  CHECK(script_json({{"a", "</script><!--"}}) == R"({"a":"\u003c/script>\u003c!--"})");
  CHECK(script_json({{"a", "\xff"}}) == "{\"a\":\"\uFFFD\"}");
  CHECK(script_source("a('</script>', '<!--')") == "a('<\\/script>', '<\\!--')");
  HtmlTable table;
  table.caption = "<i>caption</i>";
  table.name = "\"quoted\"";
  table.columns = {{"<i>column</i>"}};
  table.rows = {{{html_text("<i>cell</i>")}}};
  CHECK_THAT(html_of(table), !Contains("<i>") && !Contains("\"\"quoted"));
  CHECK_THAT(html_list({"<i>item</i>"}), !Contains("<i>"));
}

TEST_CASE("a template is filled once, and its names must be known") {
  CHECK(filled("a{{x}}b{{y}}c{{x}}", {{"x", "{{y}}"}, {"y", "2"}}) == "a{{y}}b2c{{y}}");
  CHECK(filled("nothing", {}) == "nothing");
  CHECK_THROWS_AS(filled("{{unknown}}", {{"x", ""}}), std::logic_error);
  CHECK_THROWS_AS(filled("{{x", {{"x", ""}}), std::logic_error);
}
