// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>
#include <optional>
#include <pybind11/stl.h>
#include <string>

#include "mesher/mesh/mesh_summary.h"
#include "pipeline/process/result_files.h"
#include "pipeline/python/bindings/arrays.h"
#include "pipeline/python/bindings/bindings.h"
#include "pipeline/python/bindings/computing.h"

namespace flexneck::python {

namespace {

using mesher::Mesh;

std::shared_ptr<Mesh> read_mesh(const std::string& path) {
  std::shared_ptr<Mesh> mesh;
  compute(Place::own_thread, [&](const Checkpoint&) {
    mesh = std::make_shared<Mesh>(pipeline::read_mesh(path).mesh);
  });
  return mesh;
}

py::array nodes(const py::object& self) {
  const auto& mesh = self.cast<const Mesh&>();
  static_assert(sizeof(mesh.nodes.front()) == 3 * sizeof(double));
  return view({static_cast<py::ssize_t>(mesh.nodes.size()), 3},
              mesh.nodes.empty() ? nullptr : mesh.nodes.front().data(), self);
}

py::list blocks(const py::object& self) {
  py::list list;
  for (const mesher::ElementBlock& block : self.cast<const Mesh&>().blocks) {
    const auto nodes_each = static_cast<py::ssize_t>(mesher::nodes_per_element(block.kind));
    list.append(py::make_tuple(
        block.part, std::string(mesher::name_of(block.kind)), block.material,
        view({static_cast<py::ssize_t>(block.size()), nodes_each}, block.nodes.data(), self)));
  }
  return list;
}

py::dict node_sets(const py::object& self) {
  py::dict sets;
  for (const mesher::NodeSet& set : self.cast<const Mesh&>().node_sets)
    sets[py::str(set.name)] =
        view({static_cast<py::ssize_t>(set.nodes.size())}, set.nodes.data(), self);
  return sets;
}

py::list materials(const Mesh& mesh) {
  py::list list;
  for (const mesher::Material& each : mesh.materials)
    list.append(
        py::make_tuple(each.name, each.youngs_modulus_Pa, each.poissons_ratio, each.density_kg_m3));
  return list;
}

py::list parts(const Mesh& mesh) {
  py::list list;
  for (const mesher::PartSummary& part : mesher::summarise(mesh).parts)
    list.append(py::make_tuple(part.part, std::string(mesher::name_of(part.kind)), part.material,
                               part.elements, part.volume_m3, part.mass_kg,
                               part.smallest_scaled_jacobian, part.max_aspect_ratio));
  return list;
}

}  // namespace

void bind_mesh(py::module_& module) {
  py::class_<Mesh, std::shared_ptr<Mesh>>(module, "MeshData")
      .def_property_readonly("nodes", nodes)
      .def_property_readonly("blocks", blocks)
      .def_property_readonly("node_sets", node_sets)
      .def_property_readonly("materials", materials)
      .def_property_readonly("parts", parts);
  module.def("read_mesh", read_mesh, py::arg("path"));
}

}  // namespace flexneck::python
