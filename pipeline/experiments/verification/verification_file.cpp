// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <new>

#include <nlohmann/json.hpp>

#include "geometry/foundation/error.h"
#include "geometry/foundation/input_file.h"
#include "geometry/foundation/output_file.h"
#include "pipeline/experiments/verification/verification.h"
#include "pipeline/process/provenance_json.h"

namespace flexneck::pipeline {

namespace {

constexpr std::array<const char*, 4> kStatus = {"passed", "failed", "compared", "unjudged"};
constexpr const char* kFormat = "flexneck verification";
constexpr int kSchemaVersion = 1;

nlohmann::ordered_json json_of(const VerificationRow& row) {
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

VerificationRow row_of(const nlohmann::ordered_json& json) {
  VerificationRow row;
  row.quantity = json.at("quantity").get<std::string>();
  row.detail = json.at("detail").get<std::string>();
  row.unit = json.at("unit").get<std::string>();
  row.value = json.at("value").get<std::string>();
  row.reference = json.at("reference").get<std::string>();
  const auto& error = json.at("error_percent");
  if (!error.is_null()) row.error_percent = error.get<double>();
  const auto status =
      std::find(kStatus.begin(), kStatus.end(), json.at("status").get<std::string>());
  if (status == kStatus.end()) throw InputError("a row has an unknown status");
  row.status = static_cast<VerificationRow::Status>(status - kStatus.begin());
  row.fitted = json.at("fitted").get<bool>();
  return row;
}

VerificationFile file_of(const nlohmann::ordered_json& json) {
  if (json.at("format") != kFormat || json.at("schema_version") != kSchemaVersion) {
    throw InputError("expected the format '" + std::string(kFormat) + "', version " +
                     std::to_string(kSchemaVersion));
  }
  VerificationFile file;
  file.table.reference_origins = json.value("reference_origins", file.table.reference_origins);
  for (const auto& row : json.at("rows")) file.table.rows.push_back(row_of(row));
  file.provenance = provenance_of_json(json.at("provenance"));
  return file;
}

}  // namespace

VerificationFile read_verification(const std::filesystem::path& path) {
  const std::string text = text_of_file(path);
  try {
    return file_of(nlohmann::ordered_json::parse(text));
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {  // parser, missing member, or InputError
    throw InputError(path.string() + ": " + error.what() +
                     "; make it again with 'flexneck verify'");
  }
}

void write_verification(const std::filesystem::path& path, const VerificationTable& table,
                        const Provenance& provenance) {
  nlohmann::ordered_json json = {{"format", kFormat},
                                 {"schema_version", kSchemaVersion},
                                 {"passed", table.passed()},
                                 {"reference_origins", table.reference_origins},
                                 {"rows", nlohmann::ordered_json::array()}};
  for (const VerificationRow& row : table.rows) json["rows"].push_back(json_of(row));
  json["provenance"] = json_of(provenance);
  write_text(path, json.dump(2) + "\n");
}

}  // namespace flexneck::pipeline
