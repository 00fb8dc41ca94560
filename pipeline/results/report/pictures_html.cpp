// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/results/report/pictures_html.h"

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "geometry/foundation/input_file.h"
#include "pipeline/results/plotting/embedding.h"

namespace flexneck::pipeline {

namespace fs = std::filesystem;

namespace {

/// Kinds of pictures in the order of the page, and their content.
struct PictureKind {
  const char* prefix;
  const char* what;
};
constexpr std::array<PictureKind, 3> kSweepKinds = {
    {{"sweep-tornado-", "Shares of the variance, or rank correlations, of "},
     {"sweep-scatter-", "Rows of the sweep: "},
     {"sweep-bands-", "Percentiles of all rows: "}}};
constexpr std::array<PictureKind, 4> kFitKinds = {
    {{"fit-targets", "Distances of the best fit from its targets"},
     {"fit-curve-", "Target and fit: "},
     {"fit-profiles", "Chi-squared over each parameter, with the others fitted again"},
     {"fit-history", "Points of the prior, and those that meet all targets"}}};

std::string picture(const fs::path& path, const std::string& caption,
                    const std::string& attributes = "") {
  const std::string type = path.extension() == ".svg" ? "svg+xml" : "png";
  const std::string content = text_of_file(path);
  return "<figure" + attributes + ">\n<img alt=\"" + html_text(caption) + "\" src=\"data:image/" +
         type + ";base64," + base64(std::as_bytes(std::span(content))) + "\">\n<figcaption>" +
         html_text(caption) + "</figcaption>\n</figure>\n";
}

std::string pictures_html(const fs::path& folder, std::span<const PictureKind> kinds) {
  std::vector<fs::path> files;
  std::error_code none;
  for (const fs::directory_entry& each : fs::directory_iterator(folder, none))
    if (each.path().extension() == ".svg") files.push_back(each.path());
  std::sort(files.begin(), files.end());
  std::string html;
  for (const PictureKind& kind : kinds) {
    const std::string prefix = kind.prefix;
    for (const fs::path& file : files)
      if (const std::string stem = file.stem().string(); stem.starts_with(prefix))
        html += picture(file, kind.what + stem.substr(prefix.size()));
  }
  return html;
}

}  // namespace

std::string sweep_pictures_html(const fs::path& folder) {
  return pictures_html(folder, kSweepKinds);
}

std::string fit_pictures_html(const fs::path& folder) { return pictures_html(folder, kFitKinds); }

std::string mesh_picture_html(const fs::path& folder, const std::string& label) {
  const fs::path path = folder / "mesh.png";
  return fs::exists(path) ? picture(path, label + ": parts and mesh", " data-shows=\"neck\"") : "";
}

}  // namespace flexneck::pipeline
