// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <string>

#include "geometry/foundation/units.h"
#include "pipeline/laboratory/rating/cora.h"
#include "pipeline/laboratory/rating/iso18571.h"
#include "pipeline/laboratory/rating/nij.h"
#include "pipeline/python/bindings/bindings.h"

namespace flexneck::python {

namespace py = pybind11;
using namespace py::literals;

namespace {

py::dict iso18571(const Eigen::VectorXd& reference, const Eigen::VectorXd& computed) {
  const pipeline::Iso18571Rating rating = pipeline::rate_iso18571(reference, computed);
  return py::dict("overall"_a = rating.overall, "corridor"_a = rating.corridor,
                  "phase"_a = rating.phase, "magnitude"_a = rating.magnitude,
                  "slope"_a = rating.slope, "shift"_a = rating.shift);
}

py::dict cora(const Eigen::VectorXd& reference, const Eigen::VectorXd& computed) {
  const pipeline::CoraRating rating = pipeline::rate_cora(reference, computed);
  return py::dict("overall"_a = rating.overall, "corridor"_a = rating.corridor,
                  "progression"_a = rating.progression, "size"_a = rating.size,
                  "phase"_a = rating.phase, "shift"_a = rating.shift);
}

py::dict nij(const Eigen::VectorXd& force_z_N, const Eigen::VectorXd& moment_y_Nm,
             double interval_s, bool is_filtered, const std::string& dummy) {
  py::dict found;
  for (const pipeline::NijPeak& peak : pipeline::nij(
           {force_z_N, moment_y_Nm, interval_s, is_filtered}, pipeline::neck_intercepts(dummy)))
    found[py::str(std::string(peak.name))] =
        py::make_tuple(peak.value, static_cast<double>(peak.sample) * interval_s);
  return found;
}

}  // namespace

void bind_rating(py::module_& module) {
  module.def("iso18571", iso18571, py::arg("reference"), py::arg("computed"));
  module.def("cora", cora, py::arg("reference"), py::arg("computed"));
  module.def("nij", nij, py::arg("force_z"), py::arg("moment_y"), py::arg("interval"),
             py::arg("is_filtered"), py::arg("dummy"));
  module.def(
      "parse_quantity",
      [](const std::string& text, const std::string& unit) { return parse_quantity(text, unit); },
      py::arg("text"), py::arg("unit"));
  module.def(
      "factor_from_si",
      [](const std::string& si, const std::string& unit) { return factor_from_si(si, unit); },
      py::arg("si_unit"), py::arg("unit"));
}

}  // namespace flexneck::python
