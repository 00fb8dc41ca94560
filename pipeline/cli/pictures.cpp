// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/core.h>

#include "mesher/drawing/body_picture.h"
#include "mesher/drawing/colours.h"
#include "mesher/drawing/picture_sheet.h"
#include "mesher/mesh/bounding_box.h"
#include "mesher/mesh/mesh_summary.h"
#include "pipeline/cli/commands.h"
#include "pipeline/process/result_files.h"

namespace flexneck::pipeline {

namespace {

constexpr int kWidth = 560;
constexpr int kHeight = 620;
constexpr int kModeWidth = 270;
constexpr int kModeHeight = 330;
constexpr int kModeColumns = 5;
/// Maximum displacement of a drawn mode shape, over the size of the body.
constexpr double kModeAmplitude = 0.12;

std::vector<mesher::LegendEntry> legend_of(const mesher::Mesh& mesh) {
  std::vector<mesher::LegendEntry> legend;
  for (std::size_t m = 0; m < mesh.materials.size(); ++m) {
    legend.push_back({mesh.materials[m].name, mesher::category_colour(m)});
  }
  return legend;
}

mesher::PictureSheet mesh_sheet(const mesher::Mesh& mesh, const mesher::Surface& surface) {
  const mesher::MeshSummary summary = mesher::summarise(mesh);
  mesher::BodyPicture parts;
  parts.element_edges = false;
  mesher::PictureSheet sheet;
  sheet.columns = 2;
  sheet.panels.push_back({"Parts", mesher::draw_body(mesh, surface, parts, {}, kWidth, kHeight)});
  sheet.panels.push_back({"Mesh", mesher::draw_body(mesh, surface, {}, {}, kWidth, kHeight)});
  sheet.caption = fmt::format("{} elements, {} nodes", summary.elements, summary.nodes);
  sheet.legend = legend_of(mesh);
  return sheet;
}

mesher::PictureSheet modes_sheet(const mesher::Mesh& mesh, const mesher::Surface& surface,
                                 const fe_modal::ModalBody& body) {
  const double amplitude_m = kModeAmplitude * mesher::bounding_box(mesh).extent_m().maxCoeff();
  mesher::PictureSheet sheet;
  sheet.columns = kModeColumns;
  for (std::size_t k = 0; k < body.shapes.size(); ++k) {
    const Eigen::VectorXd lengths = body.shapes[k].colwise().norm();
    const double largest = lengths.maxCoeff();
    mesher::BodyPicture what;
    what.displacement_m = body.shapes[k] * (amplitude_m / largest);
    what.field = lengths / largest;
    what.undeformed_outline = true;
    sheet.panels.push_back(
        {fmt::format("{}, {:.2f} Hz", body.modes[k].name,
                     body.frequencies_Hz[static_cast<Eigen::Index>(k)]),
         mesher::draw_body(mesh, surface, what, {}, kModeWidth, kModeHeight, amplitude_m)});
  }
  sheet.caption = "Mode shapes, " + body.boundary;
  sheet.scale = mesher::ScaleBar{"displacement 0", "largest"};
  return sheet;
}

}  // namespace

bool pictures_command(const CommandInput& input) {
  input.console.step("Drawing mesh and modes");
  const mesher::Mesh mesh = read_mesh(input.folder.mesh()).mesh;
  const fe_modal::ModalBody body = read_modal_body(input.folder.modes()).body;
  const mesher::Surface surface = mesher::surface_of(mesh);
  mesher::write_png(input.folder.mesh_picture(), mesh_sheet(mesh, surface));
  mesher::write_png(input.folder.modes_picture(), modes_sheet(mesh, surface, body));
  input.console.result(fmt::format("\nPictures: {}, {}", input.folder.mesh_picture().string(),
                                   input.folder.modes_picture().string()));
  return true;
}

}  // namespace flexneck::pipeline
