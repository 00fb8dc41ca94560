// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/cli/mesh_result.h"

#include <fmt/core.h>

#include "geometry/plausibility.h"
#include "mesher/exchange/xdmf_writer.h"
#include "mesher/mesh/bounding_box.h"
#include "mesher/mesh/mesh_summary.h"
#include "mesher/partition/element_partition.h"
#include "mesher/partition/node_order.h"
#include "pipeline/process/text_table.h"
#include "pipeline/version.h"

namespace flexneck::pipeline {

namespace {

std::string parts_table(const mesher::MeshSummary& summary, const ExactVolumes& exact) {
  std::vector<std::vector<std::string>> rows = {{"part", "element", "material", "elements",
                                                 "volume m^3", "mass kg", "scaled Jacobian",
                                                 "aspect ratio"}};
  if (!exact.empty()) rows[0].emplace_back("volume error");
  for (const mesher::PartSummary& part : summary.parts) {
    rows.push_back({part.part, std::string(name_of(part.kind)), part.material,
                    std::to_string(part.elements), fmt::format("{:.4g}", part.volume_m3),
                    fmt::format("{:.4g}", part.mass_kg),
                    fmt::format("{:.3f}", part.smallest_scaled_jacobian),
                    fmt::format("{:.1f}", part.max_aspect_ratio)});
    if (exact.empty()) continue;
    const double volume_m3 = exact.at(part.part);
    rows.back().push_back(fmt::format("{:+.1e}", (part.volume_m3 - volume_m3) / volume_m3));
  }
  return text_table(rows, {0, 1, 2});
}

/// Adds the partitions and the order that the study asks for; returns a line for each partition.
std::string add_orders(const MeshOrders& orders, mesher::MeshFile& file) {
  std::string lines;
  for (const int count : orders.partitions) {
    const mesher::ElementPartition partition = mesher::partition_elements(file.mesh, count);
    const mesher::PartitionQuality quality = mesher::quality_of(file.mesh, partition);
    lines += fmt::format("\nPartition for {} processes: edge cut {}, balance {:.3f}", count,
                         quality.edge_cut, quality.balance);
    file.partitions[count] = partition.processes;
  }
  if (orders.node_order) file.node_order = mesher::nested_dissection(file.mesh);
  return lines;
}

}  // namespace

std::string mesh_text(const mesher::Mesh& mesh, const ExactVolumes& exact, bool with_parts) {
  const mesher::MeshSummary summary = mesher::summarise(mesh);
  const Eigen::Vector3d extent = mesher::bounding_box(mesh).extent_m();
  return fmt::format("{} elements, {} nodes, {:.4g} x {:.4g} x {:.4g} m, {:.4g} kg",
                     summary.elements, summary.nodes, extent[0], extent[1], extent[2],
                     summary.mass_kg) +
         (with_parts ? "\n" + parts_table(summary, exact) : "");
}

void finish_mesh(const CommandInput& input, mesher::MeshFile file, const ExactVolumes& exact) {
  file.provenance.libraries["gmsh"] = kGmshVersion;
  const std::string partition_lines = add_orders(input.study.mesh_orders, file);
  warn_of_replaced(input, input.folder.mesh(), mesher::kMeshFormat, file.provenance);
  mesher::write_mesh(input.folder.mesh(), file);
  mesher::write_xdmf(input.folder.mesh(), file);

  const bool whole = input.console.is_verbose();
  input.console.result(
      "\nMesh  (" + input.folder.mesh().string() +
      "): " + mesh_text(file.mesh, whole ? exact : ExactVolumes{}, whole || !input.is_run) +
      partition_lines);
  const double mass_kg = mesher::summarise(file.mesh).mass_kg;
  const double extent_m = mesher::bounding_box(file.mesh).extent_m().maxCoeff();
  for (const std::string& remark : geometry::implausibilities(extent_m, mass_kg)) {
    input.console.warning(remark);
  }
  for (const mesher::Material& material : file.mesh.materials) {
    const std::string remark = geometry::implausible_density(
        material.youngs_modulus_Pa, material.poissons_ratio, material.density_kg_m3);
    if (!remark.empty()) input.console.warning("material '" + material.name + "': " + remark);
  }
}

}  // namespace flexneck::pipeline
