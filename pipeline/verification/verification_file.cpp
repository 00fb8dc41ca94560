// SPDX-License-Identifier: GPL-3.0-or-later
#include <fstream>

#include <nlohmann/json.hpp>

#include "geometry/foundation/error.h"
#include "pipeline/verification/verification.h"

namespace flexneck::pipeline {

namespace {

nlohmann::ordered_json json_of(const VerificationRow& row) {
  constexpr std::array<const char*, 3> kStatus = {"passed", "failed", "compared"};
  nlohmann::ordered_json json = {{"quantity", row.quantity},
                                 {"detail", row.detail},
                                 {"unit", row.unit},
                                 {"value", row.value},
                                 {"reference", row.reference},
                                 {"error_percent", nullptr},
                                 {"status", kStatus[static_cast<std::size_t>(row.status)]},
                                 {"fitted", row.fitted}};
  if (row.error_percent) json["error_percent"] = *row.error_percent;
  return json;
}

}  // namespace

void write_verification(const std::filesystem::path& path, const VerificationTable& table,
                        const Provenance& provenance) {
  nlohmann::ordered_json json = {{"format", "flexneck verification"},
                                 {"schema_version", 1},
                                 {"passed", table.passed()},
                                 {"rows", nlohmann::ordered_json::array()}};
  for (const VerificationRow& row : table.rows) json["rows"].push_back(json_of(row));
  json["provenance"] = {{"program", provenance.program}, {"git_hash", provenance.git_hash}};
  for (const InputFile& input : provenance.inputs) {
    json["provenance"]["inputs"][input.name] = input.hash;
  }
  std::filesystem::path temporary = path;
  temporary += ".part";
  std::ofstream file(temporary);
  file << json.dump(2) << "\n";
  file.close();
  std::error_code error;
  if (file) std::filesystem::rename(temporary, path, error);
  if (!file || error) {
    std::filesystem::remove(temporary, error);
    throw InputError(path.string() + ": cannot be written; choose another folder with -o");
  }
}

}  // namespace flexneck::pipeline
