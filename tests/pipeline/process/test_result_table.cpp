// SPDX-License-Identifier: GPL-3.0-or-later
#include <fstream>
#include <sstream>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/foundation/error.h"
#include "geometry/foundation/temporary_folder.h"
#include "pipeline/process/result_table.h"
#include "pipeline/process/text_table.h"

using Catch::Matchers::Contains;
using namespace flexneck;
using namespace flexneck::pipeline;

namespace {

const ResultTable kTable{
    "peaks", "Largest values", {{"case", ""}, {"φ", "deg"}}, {{"a \"b\"", "1.0"}}, {"A note."}};

}  // namespace

TEST_CASE("a result table is printed with its units and notes") {
  CHECK(printed(kTable) ==
        "Largest values\n"
        "  case   φ deg\n"
        "  -----  -----\n"
        "  a \"b\"    1.0\n"
        "  A note.");
}

TEST_CASE("a table that is wider than the console goes on below, behind its first column") {
  ResultTable table{"wide", "Wide", {{"case", ""}}, {{"α"}, {"b"}}, {}};
  for (int k = 1; k <= 12; ++k) {
    table.columns.push_back({"column number " + std::to_string(k), ""});
    table.rows[0].push_back(std::to_string(k));
    table.rows[1].push_back(std::to_string(-k));
  }
  std::istringstream lines(printed(table));
  std::vector<std::string> shown;
  for (std::string line; std::getline(lines, line);) shown.push_back(line);
  REQUIRE(shown.size() == 1 + 3 * 4 + 2);  // three blocks, separated by an empty line
  for (const std::string& line : shown) CHECK(line.size() <= 101);  // α is two bytes
  CHECK(shown[1] ==
        "  case  column number 1  column number 2  column number 3  column number 4  "
        "column number 5");
  CHECK(shown[5].empty());
  CHECK_THAT(shown[6], Contains("  case  column number 6  "));
  CHECK_THAT(shown[8], Catch::Matchers::StartsWith("  α                   6"));
}

TEST_CASE("texts in a table that is too wide take several lines, broken between words") {
  const std::string words(120, 'x');
  const std::string text = "a text of many words that goes on for longer than a column may be wide";
  const std::string shown =
      text_table({{"what", "note"}, {"long " + words, text}, {"short", ""}}, {0, 1});
  CHECK(shown ==
        "  what                                              note\n"
        "  ------------------------------------------------  " +
            std::string(44, '-') +
            "\n"
            "  long                                              a text of many words that goes on "
            "for longer\n"
            "  " +
            std::string(48, 'x') + "  than a column may be wide\n  " + std::string(48, 'x') +
            "\n  " + std::string(24, 'x') + "\n  short");
}

TEST_CASE("result tables come back from JSON as they were, with what they were made from") {
  const TemporaryFolder folder;
  Provenance provenance;
  provenance.program = "flexneck 1";
  provenance.inputs = {{"modes.h5", "00ff"}};
  write_tables(folder / "peaks.json", {kTable}, provenance);
  std::ifstream file(folder / "peaks.json");
  const nlohmann::json json = nlohmann::json::parse(file);
  CHECK(json["format"] == "flexneck tables");
  CHECK(json["format_version"] == 1);
  CHECK(json["provenance"]["inputs"]["modes.h5"] == "00ff");
  const nlohmann::json& table = json["tables"].at(0);
  CHECK(table["name"] == kTable.name);
  CHECK(table["title"] == kTable.title);
  CHECK(table["columns"].at(1)["name"] == "φ");
  CHECK(table["columns"].at(1)["unit"] == "deg");
  CHECK(table["rows"].get<std::vector<std::vector<std::string>>>() == kTable.rows);
  CHECK(table["notes"].get<std::vector<std::string>>() == kTable.notes);
  CHECK_FALSE(std::filesystem::exists(folder / "peaks.json.part"));
  CHECK_THROWS_WITH(write_tables(folder / "none/peaks.json", {kTable}, provenance),
                    Contains("cannot be written"));
}
