// SPDX-License-Identifier: GPL-3.0-or-later
#include <fstream>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/foundation/error.h"
#include "geometry/foundation/temporary_folder.h"
#include "pipeline/output/result_table.h"

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
