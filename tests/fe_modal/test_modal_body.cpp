// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "fe_modal/body/modal_body.h"
#include "geometry/foundation/error.h"
#include "tests/support/point_mass_body.h"

namespace flexneck::fe_modal {

TEST_CASE("interfaces and modes are found by name, and unknown ones refused with those there are") {
  const ModalBody body = testing::make_point_mass_body(3).body;
  CHECK(body.interface("tip").name == "tip");
  CHECK(body.mode_index("mode 2") == 1);
  CHECK_THROWS_AS(body.interface("tap"), InputError);
  CHECK_THROWS_WITH(body.interface("tap"), Catch::Contains("did you mean 'tip'") &&
                                               Catch::Contains("root") && Catch::Contains("side"));
  CHECK_THROWS_WITH(body.mode_index("mode 9"), Catch::Contains("mode 3"));
}

TEST_CASE("selected modes are those of a body that never had the others") {
  // The invariants of a selection are the sums over the points with the selected shapes alone.
  const testing::PointMassBody whole = testing::make_point_mass_body(5, 4);
  const ModalBody part = select_modes(whole.body, {"mode 4", "mode 2"});
  const std::vector<std::size_t> kept = {3, 1};
  std::vector<Eigen::Matrix3Xd> shapes;
  for (const std::size_t k : kept) shapes.push_back(whole.body.shapes[k]);
  const InertiaInvariants expected =
      testing::invariants_of_points(whole.masses_kg, whole.body.nodes_m, shapes);

  REQUIRE(part.mode_count() == 2);
  CHECK(part.modes[0].name == "mode 4");
  CHECK(part.frequencies_Hz[1] == whole.body.frequencies_Hz[1]);
  CHECK(part.shapes == shapes);
  CHECK(part.nodes_m == whole.body.nodes_m);
  CHECK(part.boundary == whole.body.boundary);
  CHECK(part.completeness == whole.body.completeness);
  CHECK(part.interface("tip").translation.col(0) == whole.body.interface("tip").translation.col(3));
  CHECK(part.interface("side").rotation.col(1) == whole.body.interface("side").rotation.col(1));
  CHECK(part.invariants.mass == expected.mass);
  CHECK(part.invariants.S1 == expected.S1);
  CHECK(part.invariants.S2 == expected.S2);
  CHECK(part.invariants.J0 == expected.J0);
  CHECK(part.invariants.G0 == expected.G0);
  CHECK(part.invariants.G == expected.G);
  CHECK(part.invariants.N0 == expected.N0);
  CHECK(part.invariants.N == expected.N);
  CHECK(part.invariants.Maa == expected.Maa);
}

TEST_CASE("selections of unknown or repeated modes are refused") {
  const ModalBody body = testing::make_point_mass_body(3).body;
  CHECK_THROWS_AS(select_modes(body, {"mode 1", "bending 1"}), InputError);
  CHECK_THROWS_AS(select_modes(body, {"mode 1", "mode 1"}), InputError);
}

}  // namespace flexneck::fe_modal
