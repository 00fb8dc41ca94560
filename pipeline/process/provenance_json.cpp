// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/process/provenance_json.h"

#include <string>

#include <nlohmann/json.hpp>

namespace flexneck::pipeline {

nlohmann::ordered_json json_of(const Provenance& provenance) {
  nlohmann::ordered_json json = {{"program", provenance.program},
                                 {"git_hash", provenance.git_hash},
                                 {"inputs", nlohmann::ordered_json::object()}};
  for (const InputFile& input : provenance.inputs) json["inputs"][input.name] = input.hash;
  return json;
}

Provenance provenance_of_json(const nlohmann::ordered_json& json) {
  Provenance provenance;
  provenance.program = json.at("program").get<std::string>();
  provenance.git_hash = json.at("git_hash").get<std::string>();
  for (const auto& input : json.at("inputs").items())
    provenance.inputs.push_back({input.key(), input.value().get<std::string>()});
  return provenance;
}

}  // namespace flexneck::pipeline
