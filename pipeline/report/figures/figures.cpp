// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/report/figures/figures.h"

#include <algorithm>

#include <fmt/core.h>

#include "geometry/foundation/error.h"
#include "geometry/foundation/input_file.h"
#include "geometry/foundation/output_file.h"
#include "geometry/foundation/temporary_folder.h"
#include "pipeline/plotting/embedding.h"
#include "pipeline/plotting/gnuplot.h"
#include "pipeline/report/figures/mesh_figures.h"
#include "pipeline/report/figures/neck_drawings.h"
#include "pipeline/report/figures/response_figures.h"

namespace flexneck::pipeline {

namespace fs = std::filesystem;

namespace {

constexpr const char* kScript = "figures.gp";

std::vector<Figure> all_figures(const Results& results, const Study& study) {
  std::vector<Figure> figures = neck_drawings(results, study);
  for (auto& more : {mesh_figures(results), response_figures(results, study)}) {
    figures.insert(figures.end(), more.begin(), more.end());
  }
  std::sort(figures.begin(), figures.end(),
            [](const Figure& a, const Figure& b) { return a.number < b.number; });
  return figures;
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw InputError(folder.string() + ": cannot be made (" + error.message() + ")");
}

/// gnuplot does not tell when its last bytes found no room.
std::string whole_svg(const fs::path& path) {
  std::string text = text_of_file(path);
  if (text.find("</svg>") == std::string::npos) {
    throw ComputationError(path.string() +
                           ": gnuplot has left the figure incomplete; is the disk "
                           "full?");
  }
  return text;
}

std::string html_of(const DrawnFigure& drawn) {
  const Figure& figure = drawn.figure;
  const std::string name = fmt::format("Figure {}", figure.number);
  std::string html = "<figure id=\"" + stem_of(figure) + "\">\n";
  if (!drawn.svg.empty()) {
    html += "<img loading=\"lazy\" alt=\"" + name + ": " + html_text(figure.caption) +
            "\" src=\"data:image/svg+xml;base64," + base64(std::as_bytes(std::span(drawn.svg))) +
            "\">\n";
  }
  html += "<figcaption><b>" + name + ".</b> " + html_text(figure.caption) + ". " +
          "<span class=\"note\">" + html_text(figure.remark);
  html += drawn.svg.empty() ? " Not drawn: there is not " + html_text(figure.missing) + "."
                            : " Data: figures/" + stem_of(figure) + ".csv.";
  return html + "</span></figcaption>\n</figure>\n";
}

}  // namespace

std::vector<DrawnFigure> draw_figures(const Results& results, const Study& study,
                                      const fs::path& folder) {
  if (study.neck() == nullptr) return {};
  const TemporaryFolder workshop;
  std::vector<DrawnFigure> drawn;
  std::string script;
  for (Figure& figure : all_figures(results, study)) {
    if (figure.missing.empty()) {
      write_text(workshop / (stem_of(figure) + ".csv"), figure.csv, Durability::none);
      script += figure.script;
    }
    drawn.push_back({std::move(figure), ""});
  }
  write_text(workshop / kScript, script + "set output\n", Durability::none);
  run_gnuplot(workshop.path(), kScript);
  make_folder(folder);
  for (DrawnFigure& each : drawn) {
    const std::string stem = stem_of(each.figure);
    if (each.figure.missing.empty()) {
      each.svg = whole_svg(workshop / (stem + ".svg"));
      write_text(folder / (stem + ".svg"), each.svg, Durability::none);
      write_text(folder / (stem + ".csv"), each.figure.csv, Durability::none);
    } else {
      fs::remove(folder / (stem + ".svg"));
      fs::remove(folder / (stem + ".csv"));
    }
  }
  return drawn;
}

std::string figures_html(const std::vector<DrawnFigure>& figures) {
  if (figures.empty()) return {};
  std::string html = "<div class=\"figures\">\n";
  for (const DrawnFigure& figure : figures) html += html_of(figure);
  return html + "</div>\n";
}

}  // namespace flexneck::pipeline
