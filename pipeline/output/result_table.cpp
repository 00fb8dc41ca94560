// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/output/result_table.h"

#include <fstream>

#include <nlohmann/json.hpp>

#include "geometry/foundation/error.h"
#include "pipeline/text_table.h"

namespace flexneck::pipeline {

namespace fs = std::filesystem;

namespace {

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

nlohmann::ordered_json json_of(const Provenance& provenance) {
  nlohmann::ordered_json json = {{"program", provenance.program},
                                 {"git_hash", provenance.git_hash},
                                 {"inputs", nlohmann::ordered_json::object()}};
  for (const InputFile& input : provenance.inputs) json["inputs"][input.name] = input.hash;
  return json;
}

}  // namespace

std::string printed(const ResultTable& table) {
  std::vector<std::vector<std::string>> rows(1);
  for (const ResultTable::Column& column : table.columns)
    rows.front().push_back(column.name + (column.unit.empty() ? "" : " " + column.unit));
  rows.insert(rows.end(), table.rows.begin(), table.rows.end());
  std::string text = table.title + "\n" + text_table(rows);
  for (const std::string& note : table.notes) text += "\n  " + note;
  return text;
}

void write_tables(const fs::path& path, const std::vector<ResultTable>& tables,
                  const Provenance& provenance) {
  nlohmann::ordered_json json = {{"format", "flexneck tables"},
                                 {"format_version", kFormatVersion},
                                 {"provenance", json_of(provenance)},
                                 {"tables", nlohmann::ordered_json::array()}};
  for (const ResultTable& table : tables) json["tables"].push_back(json_of(table));
  fs::path temporary = path;
  temporary += ".part";
  std::ofstream file(temporary, std::ios::binary);
  file << json.dump(2) << '\n';
  file.close();
  std::error_code error;
  if (file) fs::rename(temporary, path, error);
  if (!file || error) {
    std::error_code ignored;
    fs::remove(temporary, ignored);
    throw InputError(path.string() + ": cannot be written; choose another folder with -o");
  }
}

}  // namespace flexneck::pipeline
