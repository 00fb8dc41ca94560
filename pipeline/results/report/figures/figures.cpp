// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/results/report/figures/figures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/core.h>

#include "geometry/foundation/error.h"
#include "geometry/foundation/input_file.h"
#include "geometry/foundation/output_file.h"
#include "geometry/foundation/temporary_folder.h"
#include "geometry/foundation/units.h"
#include "mesher/drawing/colours.h"
#include "mesher/mesh/boundary.h"
#include "mesher/mesh/positions.h"
#include "pipeline/results/plotting/embedding.h"
#include "pipeline/results/plotting/figure.h"
#include "pipeline/results/plotting/gnuplot.h"
#include "pipeline/results/report/figures/neck_drawings.h"
#include "pipeline/results/report/figures/response_figures.h"
#include "pipeline/results/report/figures/tornado_figure.h"
#include "pipeline/results/report/results.h"

namespace flexneck::pipeline {

namespace {

/// Maximum number of facets: more make a vector picture too large; mesh.png shows them.
constexpr std::size_t kMaxFacets = 6000;
/// Maximum displacement of a drawn mode, over the length of the body.
constexpr double kAmplitude = 0.2;
/// Angles of gnuplot's "set view": about the picture's horizontal, then about z, degrees.
constexpr double kTilt = 68;
constexpr double kTurn = 35;

Eigen::Vector3d towards_eye() {
  const double tilt = kTilt * std::numbers::pi / 180;
  const double turn = kTurn * std::numbers::pi / 180;
  return {std::sin(tilt) * std::sin(turn), -std::sin(tilt) * std::cos(turn), std::cos(tilt)};
}

/// Corners of a facet for gnuplot's surfaces, two rows of two; a triangle repeats one.
std::array<std::int32_t, 4> grid_corners(const mesher::Facet& side) {
  const bool is_triangle = mesher::shape_of(side.kind) == mesher::ReferenceShape::triangle;
  const auto& n = side.nodes;
  return {n[0], n[1], is_triangle ? n[2] : n[3], n[2]};
}

struct Boundary {
  const mesher::Mesh& mesh;
  std::vector<mesher::Facet> sides;
};

/// CSV of the visible facets of the boundary, displaced, each with a value at its corners.
/// @param value_of  returns the value of a node on a facet
template <class ValueOf>
std::string csv_of(const Boundary& boundary, const Eigen::Matrix3Xd& positions_m,
                   const std::string& what, const ValueOf& value_of) {
  const double inch = factor_from_si("m", "in");
  const Eigen::Vector3d eye = towards_eye();
  std::string csv = "x [in],y [in],z [in]," + what + "\n";
  bool is_first = true;
  for (const mesher::Facet& side : boundary.sides) {
    const std::array<std::int32_t, 4> corners = grid_corners(side);
    const Eigen::Vector3d along = positions_m.col(corners[3]) - positions_m.col(corners[0]);
    const Eigen::Vector3d across = positions_m.col(corners[2]) - positions_m.col(corners[1]);
    if (along.cross(across).dot(eye) < 0) continue;
    if (!is_first) csv += "\n\n";
    is_first = false;
    for (std::size_t c = 0; c < 4; ++c) {
      if (c == 2) csv += "\n";
      const Eigen::Vector3d point = inch * positions_m.col(corners[c]);
      csv += fmt::format("{:.5g},{:.5g},{:.5g},{:.4g}\n", point.x(), point.y(), point.z(),
                         value_of(corners[c], side));
    }
  }
  return csv;
}

/// Axes of equal length about the middle, so that both figures have the same scale.
std::string ranges(const Eigen::Matrix3Xd& positions_m) {
  const double inch = factor_from_si("m", "in");
  const Eigen::Vector3d low = inch * positions_m.rowwise().minCoeff();
  const Eigen::Vector3d high = inch * positions_m.rowwise().maxCoeff();
  const Eigen::Vector3d middle = (low + high) / 2;
  const double half = (high - low).maxCoeff() / 2;
  std::string script;
  for (int axis = 0; axis < 3; ++axis) {
    script += fmt::format("set {}range [{:.5g}:{:.5g}]\n", "xyz"[axis], middle[axis] - half,
                          middle[axis] + half);
  }
  return script;
}

std::string surface_script(const Figure& figure, const Eigen::Matrix3Xd& positions_m,
                           const std::string& palette) {
  return script_head(figure, 560, 620) + ranges(positions_m) +
         fmt::format(
             "set view {},{},1.35,1\nset view equal xyz\nunset border\nunset tics\nunset key\n"
             "{}set pm3d depthorder corners2color mean border lc rgb '#202020' lw 0.4\n"
             "splot '{}.csv' skip 1 using 1:2:3:4 with pm3d notitle\n",
             kTilt, kTurn, palette, stem_of(figure));
}

std::string displacement_palette() {
  std::string colours;
  for (std::size_t k = 0; k < mesher::kColourScale.size(); ++k)
    colours += fmt::format("{}{} '#{:06x}'", k == 0 ? "" : ", ",
                           static_cast<double>(k) / (mesher::kColourScale.size() - 1),
                           mesher::kColourScale[k]);
  return "set palette defined (" + colours + ")\nset cbrange [0:1]\nset colorbox size 0.02,0.4\n";
}

Figure mesh_figure(const Boundary& boundary) {
  Figure figure{3, "Hybrid III finite element mesh"};
  std::size_t elements = 0;
  for (const mesher::ElementBlock& block : boundary.mesh.blocks) elements += block.size();
  figure.remark = fmt::format(
      "{} elements and {} nodes; 'flexneck mesh --preset paper' makes about as many as in the "
      "paper. Light: {}.",
      elements, boundary.mesh.nodes.size(), boundary.mesh.materials.front().name);
  figure.csv = csv_of(boundary, mesher::positions_of(boundary.mesh), "material",
                      [&](std::int32_t, const mesher::Facet& side) {
                        return static_cast<double>(boundary.mesh.blocks[side.block].material);
                      });
  figure.script = surface_script(
      figure, mesher::positions_of(boundary.mesh),
      "set palette defined (0 '#d5dbe0', 1 '#7d8794')\nset cbrange [0:1]\nunset colorbox\n");
  return figure;
}

Figure mode_figure(const Boundary& boundary, const fe_modal::ModalBody& body) {
  Figure figure{4, "Hybrid III first mode shape (36.1 Hz)"};
  const Eigen::Matrix3Xd& shape = body.shapes.front();
  const Eigen::VectorXd size = shape.colwise().norm();
  const Eigen::Vector3d extent =
      body.nodes_m.rowwise().maxCoeff() - body.nodes_m.rowwise().minCoeff();
  const Eigen::Matrix3Xd moved =
      body.nodes_m + kAmplitude * extent.maxCoeff() / size.maxCoeff() * shape;
  figure.remark = fmt::format("Here {:.2f} Hz, {}. Colour: displacement, its largest 1.",
                              body.frequencies_Hz[0], body.modes.front().name);
  figure.csv =
      csv_of(boundary, moved, "displacement",
             [&](std::int32_t node, const mesher::Facet&) { return size[node] / size.maxCoeff(); });
  figure.script = surface_script(figure, moved, displacement_palette());
  return figure;
}

/// Figures 3 and 4: the mesh, and its first mode.
std::vector<Figure> mesh_figures(const Results& results) {
  std::vector<Figure> figures = {{3, "Hybrid III finite element mesh"},
                                 {4, "Hybrid III first mode shape (36.1 Hz)"}};
  if (!results.mesh) {
    for (Figure& figure : figures) figure.missing = "the mesh";
    return figures;
  }
  const Boundary boundary{*results.mesh, mesher::boundary_facets(*results.mesh)};
  if (boundary.sides.size() > kMaxFacets) {
    for (Figure& figure : figures) {
      figure.missing = "a coarser mesh: this one is too fine for lines; see mesh.png and modes.png";
    }
    return figures;
  }
  figures[0] = mesh_figure(boundary);
  const bool has_modes =
      results.modes && !results.modes->shapes.empty() &&
      results.modes->nodes_m.cols() == static_cast<Eigen::Index>(boundary.mesh.nodes.size());
  if (has_modes) {
    figures[1] = mode_figure(boundary, *results.modes);
  } else {
    figures[1].missing = "the modes of this mesh";
  }
  return figures;
}

}  // namespace

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
  html += drawn.svg.empty()
              ? " Not drawn, since this is missing: " + html_text(figure.missing) + "."
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
