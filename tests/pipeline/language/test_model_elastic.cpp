// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <string>

#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "geometry/foundation/temporary_folder.h"
#include "pipeline/language/model/model_file.h"
#include "tests/support/model_text.h"

using Catch::Matchers::Contains;
using namespace flexneck;
using namespace flexneck::pipeline;
using testing::with;

namespace {

/// Text of a model: a box at the end of a section.
std::string section_text() {
  return "[solver]\nend_time = \"1 s\"\n[[body]]\nname = \"ground\"\nkind = \"ground\"\n" +
         testing::origin_marker_text("ground", "hook") + testing::box_text("box", "at") + R"(
[[section]]
name = "rubber"
lower = "ground.hook"
upper = "box.at"
length = ["0 m", "10 mm", "20 mm"]
translation_stiffness = ["1 N/mm", "2 N/mm", "3 N/mm"]
rotation_stiffness = ["4 N*m/rad", "5 N*m/rad", "6 N*m/rad"]
relaxation_times = ["30 ms", "1 s"]
relaxation_shares = [0.5, 0.25]
)";
}

ModelFile read(const std::string& text) {
  const TemporaryFolder folder;
  return read_model_file(testing::write_test_file(folder / "model.toml", text).string(), {});
}

}  // namespace

TEST_CASE("a section shares its stiffness among branches, and places what hangs on it") {
  const ModelFile file = read(section_text());
  const multibody::Section& section = file.model.forces.of<multibody::Section>().front();
  using Vector6d = Eigen::Matrix<double, 6, 1>;
  const Vector6d stiffness = (Vector6d() << 1000, 2000, 3000, 4, 5, 6).finished();
  const auto is_diagonal = [&](const Eigen::Matrix<double, 6, 6>& matrix, double share) {
    return matrix.isApprox(share * stiffness.asDiagonal().toDenseMatrix(), 1e-14);
  };
  CHECK(is_diagonal(section.stiffness, 0.25));
  REQUIRE(section.branches.size() == 2);
  CHECK(is_diagonal(section.branches[0].stiffness, 0.5));
  CHECK(section.branches[0].relaxation_time_s == 0.03);
  CHECK(is_diagonal(section.branches[1].stiffness, 0.25));
  CHECK(file.model.bodies[1].initial_pose.position_m.isApprox(Eigen::Vector3d(0, 0.01, 0.02)));
}

TEST_CASE("a section has rows and columns for the gaps of its slits, which relax with it") {
  const ModelFile file = read(with(section_text(), "relaxation_times", R"(
gap_stiffness = ["8 N/mm", "1 N/mm", "1 N/mm", "9 N/mm"]
gap_translation_coupling = ["0 N/m", "0 N/m", "-5 N/m", "1 N/m", "0 N/m", "-6 N/m"]
gap_rotation_coupling = ["0 N/rad", "2 N/rad", "0 N/rad", "0 N/rad", "3 N/rad", "0 N/rad"]
relaxation_times)"));
  const multibody::Section& section = file.model.forces.of<multibody::Section>().front();
  REQUIRE(section.gap_count() == 2);
  const Eigen::MatrixXd whole = 4 * section.stiffness;
  CHECK(whole.isApprox(whole.transpose()));
  CHECK(whole.bottomRightCorner(2, 2).isApprox(
      (Eigen::Matrix2d() << 8000, 1000, 1000, 9000).finished()));
  const Eigen::Matrix<double, 6, 1> second = whole.bottomLeftCorner(2, 6).row(1);
  CHECK(second.isApprox((Eigen::Matrix<double, 6, 1>() << 1, 0, -6, 0, 3, 0).finished()));
  CHECK(whole(6, 4) == Approx(2));
  CHECK(Eigen::MatrixXd(section.branches[0].stiffness).isApprox(0.5 * whole));
}

TEST_CASE(
    "temperature shifts the relaxation times of a section as Williams, Landel and Ferry have it") {
  const auto first_time_s = [](const std::string& temperature) {
    return read(section_text() + "shift = { temperature = \"" + temperature +
                "\", reference = \"298 K\", c1 = 8.86, c2 = \"101.6 K\", from = \"260 K\", to = "
                "\"330 K\" }\n")
        .model.forces.of<multibody::Section>()
        .front()
        .branches[0]
        .relaxation_time_s;
  };
  CHECK(first_time_s("298 K") == Approx(0.03));
  // log10: -8.86 * 10 / 111.6 and 8.86 * 20 / 81.6.
  CHECK(first_time_s("308 K") == Approx(0.03 * 0.1607286104).epsilon(1e-5));
  CHECK(first_time_s("278 K") == Approx(0.03 * 148.4460437).epsilon(1e-5));
  CHECK_THROWS_WITH(first_time_s("331 K"), Contains("shift.temperature") && Contains("330"));
}

TEST_CASE("what a section cannot mean is refused by its key") {
  const auto refused = [](const std::string& part, const std::string& by, const char* message) {
    CHECK_THROWS_WITH(read(with(section_text(), part, by)), Contains(message));
  };
  refused("[0.5, 0.25]", "[0.5, 0.6]", "relaxation_shares: expected shares whose sum is at most 1");
  refused("[0.5, 0.25]", "[0.5]", "relaxation_shares: expected one share per relaxation time, 2");
  refused("[0.5, 0.25]", "[0.5, 0]", "relaxation_shares: expected positive shares");
  refused("\"30 ms\"", "\"-30 ms\"", "relaxation time of branch 1 must be positive");
  refused("length =", "base = \"base\"\nlength =", "base: has no effect without modes_file");
  refused("length = [\"0 m\", \"10 mm\", \"20 mm\"]", "", "expected length and stiffness");
  refused(
      "length =", "modes_file = \"none.h5\"\nlength =", "length: modes_file determines it already");
  refused("length =", "gap_stiffness = [\"1 N/m\", \"2 N/m\"]\nlength =",
          "gap_stiffness: expected a square matrix of one to four gaps");
  refused("length =", "gap_stiffness = [\"-1 N/m\"]\nlength =", "negative eigenvalue");
  refused("length =", "gap_rotation_coupling = [\"1 N/rad\"]\nlength =",
          "gap_rotation_coupling: has no effect without gap_stiffness");
  refused("\"1 N/mm\", \"2 N/mm\", \"3 N/mm\"", "\"1 N/mm\", \"-2 N/mm\", \"3 N/mm\"",
          "must not have a negative eigenvalue");
}

TEST_CASE("a cable without a length has that of the places of its ends") {
  const ModelFile file = read(section_text() + R"(
[[cable]]
name = "wire"
lower = "ground.hook"
upper = "box.at"
stiffness = "800 N/mm"
preload = "500 N"
play = "1 mm"
)");
  const multibody::Cable& cable = file.model.forces.of<multibody::Cable>().front();
  CHECK(cable.length_m == Approx(std::hypot(0.01, 0.02)));
  CHECK(cable.preload_N == 500);
}

TEST_CASE("curves that fall are refused unless the file says that they may") {
  const auto spring = [](const std::string& law) {
    return read(section_text() +
                "[[spring]]\nname = \"rope\"\nlower = \"ground.hook\"\nupper = "
                "\"box.at\"\nfree_length = \"0.1 m\"\n" +
                law);
  };
  const std::string table =
      "deflections = [\"0 m\", \"1 m\", \"2 m\"]\nloads = [\"0 N\", \"5 N\", \"4 N\"]\n";
  CHECK_THROWS_WITH(spring(table), Contains("loads: the load falls"));
  CHECK_THROWS_WITH(
      spring("stiffness = \"1 N/m\"\nquadratic = \"-2 N/m^2\"\ncubic = \"1 N/m^3\"\n"),
      Contains("stiffness: the load falls"));
  CHECK_NOTHROW(spring("stiffness = \"1 N/m\"\nquadratic = \"-1.7 N/m^2\"\ncubic = \"1 N/m^3\"\n"));
  CHECK_NOTHROW(spring(table + "may_fall = true\n"));
  const auto bent = [](const std::string& curve) {
    return read(with(section_text(), "relaxation_times", curve + "\nrelaxation_times"));
  };
  CHECK_NOTHROW(
      bent("bending_angles = [\"0 deg\", \"5 deg\", \"9 deg\"]\nbending_moments = [\"0 N*m\", \"1 "
           "N*m\", \"3 N*m\"]"));
  CHECK_THROWS_WITH(bent("bending_angles = [\"0 deg\", \"5 deg\", \"9 deg\"]\nbending_moments = "
                         "[\"0 N*m\", \"3 N*m\", \"1 N*m\"]"),
                    Contains("never fall"));
  CHECK_THROWS_WITH(bent("bending_moments = [\"0 N*m\", \"3 N*m\"]"), Contains("bending_angles"));
}
