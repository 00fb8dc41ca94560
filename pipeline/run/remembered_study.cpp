// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/run/remembered_study.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "geometry/foundation/error.h"
#include "geometry/foundation/input_file.h"
#include "geometry/foundation/output_file.h"
#include "pipeline/language/document/shipped_files.h"

namespace flexneck::pipeline {

namespace fs = std::filesystem;

namespace {

constexpr const char* kFormat = "flexneck choice of a study";

[[noreturn]] void refuse(const fs::path& path, const std::string& found) {
  throw InputError(path.string() + ": expected the record of the study of this folder, found " +
                   found + "; name the study on the command line, or remove the file");
}

nlohmann::ordered_json json_of(const fs::path& folder, const StudyChoice& choice) {
  nlohmann::ordered_json json = {{"format", kFormat}, {"study", ""}};
  if (!choice.study.empty()) {
    const fs::path study = fs::weakly_canonical(choice.study);
    const fs::path shipped = study.lexically_relative(shipped_folder());
    const bool is_shipped = !shipped.empty() && *shipped.begin() != "..";
    json["study"] = is_shipped
                        ? shipped.generic_string()
                        : study.lexically_proximate(fs::weakly_canonical(fs::absolute(folder)))
                              .generic_string();
    if (is_shipped) json["shipped"] = true;
  }
  json["settings"] = choice.settings;
  return json;
}

}  // namespace

bool same(StudyChoice a, StudyChoice b) {
  std::sort(a.settings.begin(), a.settings.end());
  std::sort(b.settings.begin(), b.settings.end());
  return fs::weakly_canonical(a.study) == fs::weakly_canonical(b.study) && a.settings == b.settings;
}

std::string text_of_settings(const std::vector<std::string>& settings) {
  std::string text;
  for (const std::string& setting : settings)
    text += (text.empty() ? "--set " : " --set ") + setting;
  return text;
}

std::string text_of(const StudyChoice& choice) {
  const std::string study =
      choice.study.empty() ? "the built-in one" : choice.study.lexically_normal().string();
  return study + (choice.settings.empty() ? "" : " ") + text_of_settings(choice.settings);
}

StudyChoice with_settings(StudyChoice choice, const std::vector<std::string>& more) {
  const auto key_of = [](const std::string& setting) {
    return setting.substr(0, setting.find('='));
  };
  for (const std::string& setting : more) {
    std::erase_if(choice.settings,
                  [&](const std::string& old) { return key_of(old) == key_of(setting); });
    choice.settings.push_back(setting);
  }
  return choice;
}

std::optional<StudyChoice> remembered_study(const fs::path& folder) {
  const fs::path path = folder / kRememberedStudy;
  if (!fs::exists(path)) return {};
  try {
    const nlohmann::json json = nlohmann::json::parse(text_of_file(path));
    if (json.at("format") != kFormat) refuse(path, "another format");
    const auto study = json.at("study").get<std::string>();
    const auto settings = json.at("settings").get<std::vector<std::string>>();
    if (study.empty()) return StudyChoice{{}, settings};
    if (json.value("shipped", false)) return StudyChoice{shipped_file(study), settings};
    const fs::path whole = (fs::weakly_canonical(folder) / study).lexically_normal();
    return StudyChoice{whole.lexically_proximate(fs::current_path()), settings};
  } catch (const nlohmann::json::exception& error) {
    refuse(path, error.what());
  }
}

void require_rememberable(const fs::path& folder, const StudyChoice& choice) {
  try {
    json_of(folder, choice).dump();
  } catch (const nlohmann::json::type_error&) {
    throw InputError(choice.study.string() +
                     ": expected a path in UTF-8, which the folder of results records; rename the "
                     "file or its folder");
  }
}

void remember_study(const fs::path& folder, const StudyChoice& choice) {
  write_text(folder / kRememberedStudy, json_of(folder, choice).dump(1) + "\n", Durability::none);
}

}  // namespace flexneck::pipeline
