// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/process/result_table.h"

#include <new>

#include <nlohmann/json.hpp>

#include "geometry/foundation/error.h"
#include "geometry/foundation/input_file.h"
#include "geometry/foundation/output_file.h"
#include "pipeline/process/provenance_json.h"
#include "pipeline/process/text_table.h"
#include "pipeline/process/wrapped_text.h"

namespace flexneck::pipeline {

namespace fs = std::filesystem;

namespace {

constexpr const char* kFormat = "flexneck tables";
constexpr int kFormatVersion = 1;

nlohmann::ordered_json json_of(const ResultTable& table) {
  nlohmann::ordered_json columns = nlohmann::ordered_json::array();
  for (const ResultTable::Column& column : table.columns)
    columns.push_back({{"name", column.name}, {"unit", column.unit}});
  return {{"name", table.name},
          {"title", table.title},
          {"columns", columns},
          {"rows", table.rows},
          {"notes", table.notes}};
}

ResultTable table_of(const nlohmann::ordered_json& json) {
  ResultTable table;
  table.name = json.at("name").get<std::string>();
  table.title = json.at("title").get<std::string>();
  for (const auto& column : json.at("columns")) {
    table.columns.push_back(
        {column.at("name").get<std::string>(), column.at("unit").get<std::string>()});
  }
  table.rows = json.at("rows").get<std::vector<std::vector<std::string>>>();
  for (const auto& row : table.rows) {
    if (row.size() != table.columns.size()) {
      throw InputError("table '" + table.name + "' has a row of " + std::to_string(row.size()) +
                       " cells for " + std::to_string(table.columns.size()) + " columns");
    }
  }
  table.notes = json.at("notes").get<std::vector<std::string>>();
  return table;
}

TableFile file_of(const nlohmann::ordered_json& json) {
  if (json.at("format") != kFormat || json.at("format_version") != kFormatVersion) {
    throw InputError("expected the format '" + std::string(kFormat) + "', version " +
                     std::to_string(kFormatVersion));
  }
  TableFile file;
  for (const auto& table : json.at("tables")) file.tables.push_back(table_of(table));
  file.provenance = provenance_of_json(json.at("provenance"));
  return file;
}

}  // namespace

std::string printed(const ResultTable& table) {
  std::vector<std::vector<std::string>> rows(1);
  for (const ResultTable::Column& column : table.columns)
    rows.front().push_back(column.name + (column.unit.empty() ? "" : " " + column.unit));
  rows.insert(rows.end(), table.rows.begin(), table.rows.end());
  std::string text = table.title + "\n" + text_table(rows);
  for (const std::string& note : table.notes) {
    text += "\n" + wrapped(note, "  ");
    text.pop_back();
  }
  return text;
}

bool holds_tables(const fs::path& path) {
  const auto json = nlohmann::ordered_json::parse(text_of_file(path), nullptr, false);
  return json.is_object() && json.value("format", nlohmann::ordered_json()) == kFormat;
}

TableFile read_tables(const fs::path& path) {
  const std::string text = text_of_file(path);
  try {
    return file_of(nlohmann::ordered_json::parse(text));
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {  // parser, missing member, or InputError
    throw InputError(path.string() + ": " + error.what() + "; make it again with 'flexneck run'");
  }
}

void write_tables(const fs::path& path, const std::vector<ResultTable>& tables,
                  const Provenance& provenance) {
  nlohmann::ordered_json json = {{"format", kFormat},
                                 {"format_version", kFormatVersion},
                                 {"provenance", json_of(provenance)},
                                 {"tables", nlohmann::ordered_json::array()}};
  for (const ResultTable& table : tables) json["tables"].push_back(json_of(table));
  write_text(path, json.dump(2) + "\n");
}

}  // namespace flexneck::pipeline
