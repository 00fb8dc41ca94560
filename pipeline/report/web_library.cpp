// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/report/web_library.h"

#include <filesystem>
#include <vector>

#include "geometry/foundation/error.h"
#include "geometry/foundation/input_file.h"
#include "pipeline/document/shipped_files.h"
#include "pipeline/plotting/embedding.h"

namespace flexneck::pipeline {

namespace {

struct Place {
  std::string package;
  std::vector<std::string> files;  ///< the first that is there
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
  return text_of_file(shipped_file("pipeline/report/page/" + name));
}

std::string page_head(const std::string& title) {
  return filled(page_part("head.html"), {{"title", title}, {"style", page_part("report.css")}});
}

std::string script_element(const std::string& source) {
  return "<script>\n" + script_source(source) + "</script>\n";
}

}  // namespace flexneck::pipeline
