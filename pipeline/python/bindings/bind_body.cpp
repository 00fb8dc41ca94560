// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>
#include <pybind11/stl.h>
#include <string>
#include <vector>

#include "fe_modal/body/modal_body_check.h"
#include "geometry/foundation/error.h"
#include "pipeline/process/result_files.h"
#include "pipeline/python/bindings/arrays.h"
#include "pipeline/python/bindings/bindings.h"
#include "pipeline/python/bindings/computing.h"

namespace flexneck::python {

namespace {

using fe_modal::ModalBody;

std::shared_ptr<ModalBody> read_body(const std::string& path) {
  std::shared_ptr<ModalBody> body;
  compute(Place::own_thread, [&](const Checkpoint&) {
    body = std::make_shared<ModalBody>(pipeline::read_modal_body(path).body);
  });
  return body;
}

py::list modes(const ModalBody& body) {
  py::list list;
  for (const fe_modal::ModeRecord& mode : body.modes)
    list.append(py::make_tuple(mode.name, mode.kind, mode.shares_percent, mode.residual));
  return list;
}

py::list shapes(const py::object& self) {
  py::list list;
  for (const Eigen::Matrix3Xd& shape : self.cast<const ModalBody&>().shapes)
    list.append(rows_view(shape, self));
  return list;
}

/// Dictionary of interface names to position (3), translation and rotation of each mode (m, 3).
py::dict interfaces(const py::object& self) {
  py::dict all;
  for (const fe_modal::Interface& each : self.cast<const ModalBody&>().interfaces)
    all[py::str(each.name)] =
        py::make_tuple(rows_view(each.position_m, self), rows_view(each.translation, self),
                       rows_view(each.rotation, self));
  return all;
}

/// Array of the modes' matrices, (m, ...).
py::array stacked(const std::vector<Eigen::Matrix3d>& matrices,
                  const std::vector<py::ssize_t>& shape) {
  py::array_t<double> array(shape);
  double* number = array.mutable_data();
  for (const Eigen::Matrix3d& matrix : matrices)
    for (Eigen::Index i = 0; i < 3; ++i)
      for (Eigen::Index j = 0; j < 3; ++j) *number++ = matrix(i, j);
  return array;
}

py::dict invariants(const py::object& self) {
  const auto& body = self.cast<const ModalBody&>();
  const fe_modal::InertiaInvariants& all = body.invariants;
  const py::ssize_t m = body.mode_count();
  py::array_t<double> N({m, m, static_cast<py::ssize_t>(3)});
  double* number = N.mutable_data();
  for (const Eigen::Vector3d& each : all.N)
    for (Eigen::Index i = 0; i < 3; ++i) *number++ = each[i];
  py::dict found;
  found["mass"] = all.mass;
  found["S1"] = rows_view(all.S1, self);
  found["S2"] = rows_view(all.S2, self);
  found["J0"] = copied(all.J0);
  found["G0"] = stacked(all.G0, {m, 3, 3});
  found["G"] = stacked(all.G, {m, m, 3, 3});
  found["N0"] = rows_view(all.N0, self);
  found["N"] = N;
  found["Maa"] = copied(all.Maa);
  return found;
}

// Arrays that define a body built in code, with the shapes of the properties above.

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// Reads an array.
/// @param shape  required shape of the array
Numbers given(const py::dict& from, const char* name, const std::vector<py::ssize_t>& shape) {
  if (!from.contains(name)) throw InputError(std::string(name) + ": expected an array, found none");
  Numbers array = Numbers::ensure(from[name]);
  if (!array) throw py::error_already_set();
  if (std::vector<py::ssize_t>(array.shape(), array.shape() + array.ndim()) == shape) return array;
  std::string expected;
  for (const py::ssize_t length : shape)
    expected += (expected.empty() ? "" : ", ") + std::to_string(length);
  throw InputError(std::string(name) + ": expected an array of the shape (" + expected +
                   "), found " + std::string(py::str(array.attr("shape"))));
}

/// Converts rows of NumPy to columns of Eigen.
Eigen::Matrix3Xd columns(const Numbers& rows) {
  return Eigen::Map<const Eigen::Matrix3Xd>(rows.data(), 3, rows.size() / 3);
}

Eigen::MatrixXd matrix(const double* rows, Eigen::Index size) {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return Eigen::Map<const RowMajor>(rows, size, size);
}

std::vector<Eigen::Matrix3d> matrices(const Numbers& stacked) {
  std::vector<Eigen::Matrix3d> all;
  for (py::ssize_t k = 0; k < stacked.size(); k += 9)
    all.emplace_back(matrix(stacked.data() + k, 3));
  return all;
}

fe_modal::InertiaInvariants invariants_of(const py::dict& from, py::ssize_t m) {
  fe_modal::InertiaInvariants all;
  all.mass = given(from, "mass", {}).data()[0];
  all.S1 = columns(given(from, "S1", {3}));
  all.S2 = columns(given(from, "S2", {m, 3}));
  all.J0 = matrix(given(from, "J0", {3, 3}).data(), 3);
  all.G0 = matrices(given(from, "G0", {m, 3, 3}));
  all.G = matrices(given(from, "G", {m, m, 3, 3}));
  all.N0 = columns(given(from, "N0", {m, 3}));
  const Eigen::Matrix3Xd N = columns(given(from, "N", {m, m, 3}));
  for (const auto& each : N.colwise()) all.N.emplace_back(each);
  all.Maa = matrix(given(from, "Maa", {m, m}).data(), m);
  return all;
}

void build(const std::string& path, const std::vector<std::string>& names,
           const std::vector<std::string>& kinds, const py::dict& arrays,
           const py::dict& interfaces, const py::dict& invariants) {
  const auto m = static_cast<py::ssize_t>(names.size());
  fe_modal::ModalBodyFile file;
  ModalBody& body = file.body;
  for (std::size_t k = 0; k < names.size(); ++k) body.modes.push_back({names[k], kinds.at(k)});
  const Numbers frequencies = given(arrays, "frequencies", {m});
  body.frequencies_Hz = Eigen::Map<const Eigen::VectorXd>(frequencies.data(), m);
  body.boundary = "as given";
  body.completeness = "not checked";
  const Numbers nodes = Numbers::ensure(arrays["nodes"]);
  const py::ssize_t n = nodes ? nodes.size() / 3 : 0;
  body.nodes_m = columns(given(arrays, "nodes", {n, 3}));
  const Numbers all_shapes = given(arrays, "shapes", {m, n, 3});
  for (py::ssize_t k = 0; k < m; ++k)
    body.shapes.emplace_back(
        Eigen::Map<const Eigen::Matrix3Xd>(all_shapes.data() + 3 * n * k, 3, n));
  for (const auto& [name, each] : interfaces) {
    const auto parts = py::cast<py::dict>(each);
    body.interfaces.push_back({py::cast<std::string>(name), columns(given(parts, "position", {3})),
                               columns(given(parts, "translation", {m, 3})),
                               columns(given(parts, "rotation", {m, 3}))});
  }
  body.invariants = invariants_of(invariants, m);
  file.provenance.program = "Python";
  compute(Place::own_thread, [&](const Checkpoint&) {
    fe_modal::check_modal_body(body);
    fe_modal::write_modal_body(path, file);
  });
}

}  // namespace

void bind_body(py::module_& module) {
  py::class_<ModalBody, std::shared_ptr<ModalBody>>(module, "BodyData")
      .def_property_readonly("frequencies",
                             [](const py::object& self) {
                               return rows_view(self.cast<const ModalBody&>().frequencies_Hz, self);
                             })
      .def_property_readonly("modes", modes)
      .def_readonly("boundary", &ModalBody::boundary)
      .def_readonly("completeness", &ModalBody::completeness)
      .def_readonly("solver", &ModalBody::solver)
      .def_property_readonly("nodes",
                             [](const py::object& self) {
                               return rows_view(self.cast<const ModalBody&>().nodes_m, self);
                             })
      .def_property_readonly("shapes", shapes)
      .def_property_readonly("interfaces", interfaces)
      .def_property_readonly("invariants", invariants);
  module.def("read_body", read_body, py::arg("path"));
  module.def("build_body", build, py::arg("path"), py::arg("names"), py::arg("kinds"),
             py::arg("arrays"), py::arg("interfaces"), py::arg("invariants"));
}

}  // namespace flexneck::python
