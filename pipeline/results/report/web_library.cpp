// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/results/report/web_library.h"

#include <filesystem>
#include <vector>

#include <nlohmann/json.hpp>

#include "geometry/foundation/error.h"
#include "geometry/foundation/input_file.h"
#include "pipeline/language/document/shipped_files.h"
#include "pipeline/results/plotting/embedding.h"
#include "pipeline/results/report/display_units.h"

namespace flexneck::pipeline {

namespace {

struct Place {
  std::string package;
  std::vector<std::string> files;  ///< candidates, of which the first existing one is taken
};

Place place_of(WebLibrary library) {
  switch (library) {
    case WebLibrary::d3:
      return {"libjs-d3", {"/usr/share/javascript/d3/d3.min.js", "/usr/share/nodejs/d3/d3.min.js"}};
    case WebLibrary::three:
      return {"libjs-three",
              {"/usr/share/javascript/three/three.min.js",
               "/usr/share/javascript/three/build/three.min.js",
               "/usr/share/nodejs/three/build/three.min.js"}};
  }
  return {};
}

}  // namespace

std::string source_of(WebLibrary library) {
  const Place place = place_of(library);
  for (const std::string& file : place.files) {
    if (std::filesystem::exists(file)) return text_of_file(file);
  }
  throw InputError("report: " + place.files.front() + " is missing; install the package " +
                   place.package);
}

std::string page_part(const std::string& name) {
  return text_of_file(shipped_file("pipeline/results/report/page/" + name));
}

std::string page_head(const std::string& title) {
  return filled(page_part("head.html"), {{"title", title}, {"style", page_part("report.css")}});
}

void add_section(const std::string& id, const std::string& link, const std::string& title,
                 const std::string& content, std::map<std::string, std::string>& texts) {
  if (content.empty()) return;
  texts["navigation"] += "<a href=\"#" + id + "\">" + link + "</a>\n";
  texts["sections"] += "<section id=\"" + id + "\" aria-labelledby=\"" + id +
                       "-title\">\n<h2 id=\"" + id + "-title\">" + title + "</h2>\n" + content +
                       "</section>\n";
}

std::string page_data(const nlohmann::ordered_json& scenes, const nlohmann::ordered_json& curves) {
  return script_json({{"units", display_units()}, {"scenes", scenes}, {"curves", curves}});
}

std::string page_scripts(bool with_scenes, bool with_curves) {
  std::string scripts;
  if (with_curves) scripts += script_element(source_of(WebLibrary::d3));
  if (with_scenes) scripts += script_element(source_of(WebLibrary::three));
  for (const char* const name : {"data.js", "units.js", "download.js", "page.js", "plots.js",
                                 "orbit.js", "body.js", "stage.js", "clock.js", "scene.js"})
    scripts += script_element(page_part(name));
  return scripts;
}

std::string script_element(const std::string& source) {
  return "<script>\n" + script_source(source) + "</script>\n";
}

}  // namespace flexneck::pipeline
