// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <gmsh.h>

#include "mesher/gmsh/gmsh_session.h"
#include "mesher/mesh/shape_functions.h"

// gmsh 4.8 frees the closures of a prism's faces with the wrong operator delete, for which the
// address sanitizer ends the program unless this function of the sanitizer overrides it.
extern "C" const char* options_of_address_sanitizer() __asm__("__asan_default_options");
extern "C" const char* options_of_address_sanitizer() { return "alloc_dealloc_mismatch=0"; }

namespace flexneck::mesher {
namespace {

std::vector<double> functions_of_gmsh(ElementKind kind, const Eigen::Matrix3Xd& points,
                                      const std::string& space) {
  const std::vector<double> places(points.data(), points.data() + points.size());
  int components = 0;
  int orientations = 0;
  std::vector<double> values;
  gmsh::model::mesh::getBasisFunctions(traits_of(kind).gmsh_type, places, space, components, values,
                                       orientations);
  return values;
}

}  // namespace

TEST_CASE("nodes and shape functions of every kind are those of gmsh") {
  constexpr double kRounding = 1e-12;
  const GmshSession session;
  for (const ElementKind kind : element_kinds()) {
    CAPTURE(name_of(kind));
    Eigen::Matrix3Xd points(3, 3);
    points << 0.31, -0.2, 0.05, 0.22, 0.13, -0.4, 0.18, 0.41, 0.55;
    if (dimension(kind) == 2) points.row(2).setZero();
    const ShapeTable table = tabulate(kind, points);
    const Eigen::Index n = table.values.rows();

    const std::vector<double> values = functions_of_gmsh(kind, points, "Lagrange");
    REQUIRE(values.size() == static_cast<std::size_t>(table.values.size()));
    const Eigen::Map<const Eigen::MatrixXd> expected(values.data(), n, points.cols());
    CHECK((table.values - expected).cwiseAbs().maxCoeff() < kRounding);

    const std::vector<double> slopes = functions_of_gmsh(kind, points, "GradLagrange");
    for (int d = 0; d < dimension(kind); ++d) {
      const Eigen::Map<const Eigen::MatrixXd, 0, Eigen::Stride<Eigen::Dynamic, 3>> slope(
          slopes.data() + d, n, points.cols(), Eigen::Stride<Eigen::Dynamic, 3>(3 * n, 3));
      CHECK((table.derivatives[static_cast<std::size_t>(d)] - slope).cwiseAbs().maxCoeff() <
            kRounding);
    }
  }
}

}  // namespace flexneck::mesher
