// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/run/mesh_order.h"

#include <utility>

#include <fmt/core.h>

namespace flexneck::pipeline {

namespace fs = std::filesystem;

MeshOrder mesh_order(const fs::path& folder, const std::vector<const Study*>& studies) {
  MeshOrder order{folder, {}};
  for (const Study* const study : studies) order.studies.push_back({study->file, study->settings});
  return order;
}

std::vector<std::string> arguments_of(const MeshOrder& order) {
  std::vector<std::string> arguments = {order.folder.string()};
  for (const StudyChoice& each : order.studies) {
    arguments.push_back(each.study.string());
    arguments.push_back(std::to_string(each.settings.size()));
    arguments.insert(arguments.end(), each.settings.begin(), each.settings.end());
  }
  return arguments;
}

MeshOrder order_from(const std::vector<std::string>& arguments) {
  MeshOrder order{arguments.at(0), {}};
  for (std::size_t at = 1; at < arguments.size();) {
    StudyChoice choice{arguments[at], {}};
    const std::size_t settings = std::stoul(arguments.at(at + 1));
    at += 2;
    for (const std::size_t end = at + settings; at < end; ++at)
      choice.settings.push_back(arguments.at(at));
    order.studies.push_back(std::move(choice));
  }
  return order;
}

fs::path mesh_result(const MeshOrder& order, std::size_t place) {
  return order.folder / fmt::format("mesh_{}.h5", place);
}

fs::path refusal_result(const MeshOrder& order, std::size_t place) {
  return order.folder / fmt::format("refusal_{}.txt", place);
}

}  // namespace flexneck::pipeline
