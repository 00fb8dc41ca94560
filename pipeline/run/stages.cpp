// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/run/stages.h"

#include <algorithm>
#include <optional>
#include <utility>

#include <nlohmann/json.hpp>

#include "geometry/foundation/build_id.h"
#include "geometry/foundation/input_file.h"
#include "geometry/foundation/output_file.h"
#include "pipeline/run/remembered_study.h"

namespace flexneck::pipeline {

namespace fs = std::filesystem;

namespace {

constexpr const char* kFile = "stages.json";
constexpr const char* kFormat = "flexneck stages";

using WriteTimes = std::map<std::string, fs::file_time_type>;

WriteTimes write_times(const fs::path& folder) {
  WriteTimes times;
  if (!fs::is_directory(folder)) return times;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file() || entry.path().filename() == kFile) continue;
    times[entry.path().lexically_relative(folder).generic_string()] = entry.last_write_time();
  }
  return times;
}

std::map<std::string, std::string> hashes_of_written(const fs::path& folder,
                                                     const WriteTimes& before) {
  std::map<std::string, std::string> hashes;
  for (const auto& [name, time] : write_times(folder)) {
    const auto known = before.find(name);
    if (known == before.end() || known->second != time) {
      hashes[name] = hash_of_file((folder / name).string());
    }
  }
  return hashes;
}

nlohmann::ordered_json json_of(const std::vector<FileRead>& reads) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const FileRead& file : reads) json.push_back({file.path, file.hash});
  return json;
}

std::vector<FileRead> reads_from(const nlohmann::json& json) {
  std::vector<FileRead> reads;
  for (const auto& file : json)
    reads.push_back({file.at(0).get<std::string>(), file.at(1).get<std::string>()});
  return reads;
}

}  // namespace

Stages::Stages(fs::path folder, bool redo) : folder_(std::move(folder)), program_(build_id()) {
  if (!redo) read();
}

bool Stages::is_made(const std::string& stage, const Provenance& from,
                     const std::vector<std::string>& after) const {
  const auto known = records_.find(stage);
  return known != records_.end() && known->second.inputs == hash_of_inputs(from, after) &&
         is_there(known->second);
}

bool Stages::make(const std::string& stage, const Provenance& from,
                  const std::vector<std::string>& after, const std::function<void()>& work) {
  if (is_made(stage, from, after)) return false;
  records_.erase(stage);
  told_.clear();
  const WriteTimes before = write_times(folder_);
  const FilesRead reads;
  work();
  Record record{hash_of_inputs(from, after), hashes_of_written(folder_, before), {}, told_};
  record.reads = reads_beside_outputs(reads, record);
  records_[stage] = std::move(record);
  write();
  return true;
}

const std::vector<std::string>& Stages::warnings(const std::string& stage) const {
  return records_.at(stage).warnings;
}

std::vector<FileRead> Stages::reads_beside_outputs(const FilesRead& reads,
                                                   const Record& record) const {
  std::vector<FileRead> others = reads.files();
  const auto leave_out = [&](const std::string& name) {
    const std::string path = fs::absolute(folder_ / name).string();
    std::erase_if(others, [&](const FileRead& file) { return file.path == path; });
  };
  for (const auto& [name, hash] : record.outputs) leave_out(name);
  // A stage that looks through all files of the folder also finds its records.
  leave_out(kFile);
  leave_out(kRememberedStudy);
  return others;
}

std::string Stages::hash_of_inputs(const Provenance& from,
                                   const std::vector<std::string>& after) const {
  // A line break ends each field: names, values and notes contain none.
  std::string text = program_ + '\n';
  for (const InputFile& file : from.inputs) text += file.name + '\n' + file.hash + '\n';
  for (const Parameter& parameter : from.parameters) {
    text += parameter.key + '\n' + parameter.value + '\n' + std::string(name_of(parameter.origin)) +
            '\n' + parameter.note + '\n';
  }
  for (const std::string& stage : after) {
    const auto record = records_.find(stage);
    if (record == records_.end()) continue;
    for (const auto& [name, hash] : record->second.outputs) text += name + '\n' + hash + '\n';
  }
  return hash_of_text(text);
}

bool Stages::is_there(const Record& record) const {
  const bool is_same =
      std::all_of(record.reads.begin(), record.reads.end(),
                  [](const FileRead& file) { return hash_now(file.path) == file.hash; });
  return is_same &&
         std::all_of(record.outputs.begin(), record.outputs.end(), [&](const auto& output) {
           const fs::path path = folder_ / output.first;
           return fs::is_regular_file(path) && computed_hash_of_file(path) == output.second;
         });
}

void Stages::read() {
  if (!fs::exists(folder_ / kFile)) return;
  const nlohmann::json json = nlohmann::json::parse(text_of_file(folder_ / kFile), nullptr, false);
  try {
    if (json.at("format") != kFormat || json.at("program") != program_) return;
    std::map<std::string, Record> records;
    for (const auto& [stage, record] : json.at("stages").items()) {
      records[stage] = {record.at("inputs").get<std::string>(),
                        record.at("outputs").get<std::map<std::string, std::string>>(),
                        reads_from(record.at("reads")),
                        record.at("warnings").get<std::vector<std::string>>()};
    }
    records_ = std::move(records);
  } catch (const nlohmann::json::exception&) {
    // The file is damaged or of another program: all stages are made again.
  }
}

void Stages::write() const {
  nlohmann::ordered_json json = {
      {"format", kFormat}, {"program", program_}, {"stages", nlohmann::ordered_json::object()}};
  for (const auto& [stage, record] : records_) {
    json["stages"][stage] = {{"inputs", record.inputs},
                             {"outputs", record.outputs},
                             {"reads", json_of(record.reads)},
                             {"warnings", record.warnings}};
  }
  // A path that is not UTF-8 cannot be checked again: its stage is made again.
  const std::string text =
      json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  write_text(folder_ / kFile, text + "\n", Durability::none);
}

}  // namespace flexneck::pipeline
