// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/results/report/figures/figures.h"

#include <algorithm>
#include <array>

#include <fmt/core.h>

#include "geometry/foundation/error.h"
#include "geometry/foundation/input_file.h"
#include "geometry/foundation/output_file.h"
#include "geometry/foundation/temporary_folder.h"
#include "pipeline/results/plotting/embedding.h"
#include "pipeline/results/plotting/gnuplot.h"
#include "pipeline/results/report/figures/mesh_figures.h"
#include "pipeline/results/report/figures/neck_drawings.h"
#include "pipeline/results/report/figures/response_figures.h"
#include "pipeline/results/report/figures/tornado_figure.h"

namespace flexneck::pipeline {

namespace fs = std::filesystem;

namespace {

constexpr const char* kScript = "figures.gp";

std::vector<Figure> all_figures(const Results& results, const Study& study) {
  std::vector<Figure> figures = {tornado_figure(results)};
  if (study.neck() == nullptr) return figures;
  std::vector<Figure> drawings = neck_drawings(results, study);
  figures.insert(figures.end(), drawings.begin(), drawings.end());
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

/// Removes the files of a figure from an earlier run.
void remove_files(const fs::path& folder, const Figure& figure) {
  fs::remove(folder / (stem_of(figure) + ".svg"));
  fs::remove(folder / (stem_of(figure) + ".csv"));
}

/// Reads a picture and checks its end, since gnuplot does not report a full disk.
std::string whole_svg(const fs::path& path) {
  std::string text = text_of_file(path);
  if (text.find("</svg>") == std::string::npos) {
    throw ComputationError(path.string() +
                           ": gnuplot has left the figure incomplete; is the disk "
                           "full?");
  }
  return text;
}

/// True for pictures that replace the moving neck in a browser without WebGL.
bool shows_neck(const Figure& figure) {
  static constexpr std::array kNumbers = {3, 4, 5, 7};
  return std::find(kNumbers.begin(), kNumbers.end(), figure.number) != kNumbers.end();
}

std::string html_of(const DrawnFigure& drawn) {
  const Figure& figure = drawn.figure;
  const bool is_of_paper = figure.number > 0;
  const std::string name = is_of_paper ? fmt::format("Figure {}", figure.number) : "Picture";
  std::string html = "<figure id=\"" + stem_of(figure) + "\"" +
                     (shows_neck(figure) && !drawn.svg.empty() ? " data-shows=\"neck\"" : "") +
                     ">\n";
  if (!drawn.svg.empty()) {
    html += "<img loading=\"lazy\" alt=\"" + name + ": " + html_text(figure.caption) +
            "\" src=\"data:image/svg+xml;base64," + base64(std::as_bytes(std::span(drawn.svg))) +
            "\">\n";
  }
  html += "<figcaption>" + (is_of_paper ? "<b>" + name + ".</b> " : "") +
          html_text(figure.caption) + ". <span class=\"note\">" + html_text(figure.remark);
  html += drawn.svg.empty() ? " Not drawn: there is not " + html_text(figure.missing) + "."
                            : " Data: figures/" + stem_of(figure) + ".csv.";
  return html + "</span></figcaption>\n</figure>\n";
}

}  // namespace

std::vector<DrawnFigure> draw_figures(const Results& results, const Study& study,
                                      const fs::path& folder) {
  std::vector<Figure> figures = all_figures(results, study);
  const bool draws = std::any_of(figures.begin(), figures.end(),
                                 [](const Figure& figure) { return figure.missing.empty(); });
  if (study.neck() == nullptr && !draws) {
    remove_files(folder, figures.front());
    return {};
  }
  const TemporaryFolder workshop;
  std::vector<DrawnFigure> drawn;
  std::string script;
  for (Figure& figure : figures) {
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
      remove_files(folder, each.figure);
    }
  }
  return drawn;
}

std::string figures_html(const std::vector<DrawnFigure>& figures) {
  std::string html;
  for (const DrawnFigure& figure : figures)
    if (figure.figure.number > 0) html += html_of(figure);
  return html.empty() ? html : "<div class=\"figures\">\n" + html + "</div>\n";
}

std::string tornado_html(const std::vector<DrawnFigure>& figures) {
  for (const DrawnFigure& figure : figures)
    if (figure.figure.number == 0 && !figure.svg.empty()) return html_of(figure);
  return {};
}

}  // namespace flexneck::pipeline
