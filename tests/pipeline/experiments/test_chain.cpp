// SPDX-License-Identifier: GPL-3.0-or-later
// The shipped models of the neck as a chain of four bodies, compared with the neck as one body, on
// the coarsest mesh.
#include <cmath>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "geometry/foundation/temporary_folder.h"
#include "multibody/analysis/linearisation.h"
#include "multibody/simulation/simulation.h"
#include "pipeline/language/model/model_file.h"
#include "tests/support/coarse_neck.h"
#include "tests/support/flexneck_command.h"
#include "tests/support/model_text.h"

using namespace flexneck;
using namespace flexneck::pipeline;
using multibody::History;
using Settings = std::vector<std::string>;

namespace {

/// The neck and its pieces.
class Bodies {
 public:
  explicit Bodies(const std::string& settings = {}) {
    const std::string more = " " + std::string(FLEXNECK_SOURCE_DIR) +
                             "/pipeline/data/studies/hybrid3_chain.toml -q -o " +
                             folder_.path().string() + testing::kCoarseNeck + settings;
    for (const char* stage : {"mesh", "modes"}) {
      const testing::CommandOutcome outcome = testing::run_flexneck(stage + more);
      INFO(outcome.text);
      REQUIRE(outcome.exit_code == 0);
    }
  }

  Settings chain() const {
    Settings settings;
    for (int k = 1; k <= 4; ++k) {
      const std::string disc = "disc_" + std::to_string(k);
      settings.push_back("body." + disc +
                         ".modes_file=" + (folder_ / ("substructure_" + disc + ".h5")).string());
    }
    return settings;
  }
  std::string file_of(const std::string& piece) const {
    return (folder_ / ("substructure_" + piece + ".h5")).string();
  }
  /// Settings of the single body with its whole static compliance.
  Settings single() const {
    return {"body.neck.modes_file=" + (folder_ / "modes.h5").string(),
            "body.neck.modes=['normal', 'residual']"};
  }
  /// Settings of the single body with the paper's four modes, as shipped.
  Settings published(bool stiffens) const {
    return {"body.neck.modes_file=" + (folder_ / "modes.h5").string(),
            std::string("body.neck.stress_stiffening=") + (stiffens ? "true" : "false")};
  }

 private:
  TemporaryFolder folder_;
};

const Bodies& bodies() {
  static const Bodies made;
  return made;
}

ModelFile read(const std::string& model, Settings settings, const Settings& more) {
  settings.insert(settings.end(), more.begin(), more.end());
  return read_model_file(
      std::string(FLEXNECK_SOURCE_DIR) + "/pipeline/data/models/" + model + ".toml", settings);
}

/// Static state under the forward load.
struct Rest {
  Eigen::Vector3d top_m;
  double rotation_rad;
  double base_moment_Nm;
};

Rest rest_under(int load_lbf, const std::string& model, const Settings& settings,
                const std::string& top, multibody::Formulation formulation) {
  const std::string load = "'" + std::to_string(load_lbf) + " lbf'";
  ModelFile file =
      read(model, settings, {"force.forward load.magnitudes=[" + load + ", " + load + "]"});
  file.solver.formulation = formulation;
  const History history =
      multibody::simulate_from_equilibrium(file.model, file.solver, {1e-4, 1e-4});
  const multibody::MarkerHistory& marker = history.marker(top);
  const Eigen::Vector4d q = marker.rotation.col(0);
  return {marker.position_m.col(0), 2 * std::atan2(q[2], q[0]),
          history.joint("clamp").moment_Nm(1, 0)};
}

Rest chain_under(int load_lbf,
                 multibody::Formulation formulation = multibody::Formulation::recursive) {
  return rest_under(load_lbf, "static_chain", bodies().chain(), "disc_4.top", formulation);
}

/// Static state of the discs as sections between rigid plates, under the same load.
Rest sections_under(double load_lbf, multibody::Formulation formulation) {
  std::string text = R"(
[solver]
end_time = "0.1 ms"
relative_tolerance = 1e-8
[[body]]
name = "ground"
kind = "ground"
)" + testing::origin_marker_text("ground", "top");
  for (int k = 1; k <= 4; ++k) {
    const std::string disc = "disc_" + std::to_string(k);
    const std::string below = k == 1 ? "ground" : "disc_" + std::to_string(k - 1);
    const std::string base = k == 1 ? "base" : "to_" + below;
    const std::string top = k == 4 ? "top" : "to_disc_" + std::to_string(k + 1);
    text += testing::box_text(disc, "top") + "\n[[section]]\nname = \"" + disc + "\"\nlower = \"" +
            below + ".top\"\nupper = \"" + disc + ".top\"\nmodes_file = \"" +
            bodies().file_of(disc) + "\"\nbase = \"" + base + "\"\ntop = \"" + top + "\"\n";
  }
  text += "[[force]]\nname = \"load\"\nmarker = \"disc_4.top\"\ndirection = [1, 0, 0]\n" +
          ("magnitude = \"" + std::to_string(load_lbf) + " lbf\"\n");
  const TemporaryFolder folder;
  ModelFile file =
      read_model_file(testing::write_test_file(folder / "sections.toml", text).string(), {});
  file.solver.formulation = formulation;
  const History history =
      multibody::simulate_from_equilibrium(file.model, file.solver, {1e-4, 1e-4});
  const multibody::MarkerHistory& marker = history.marker("disc_4.top");
  const Eigen::Vector4d q = marker.rotation.col(0);
  return {marker.position_m.col(0), 2 * std::atan2(q[2], q[0]), 0};
}

Rest single_under(int load_lbf, const Settings& settings) {
  return rest_under(load_lbf, "static_test", settings, "neck.top",
                    multibody::Formulation::recursive);
}

/// Bound of the neck's compliance lost at the chain's rigid cuts, as a fraction.
constexpr double kRigidCuts = 2e-3;

}  // namespace

TEST_CASE("the chain is the single body where deflections are small") {
  const Rest chain = chain_under(1);
  const Rest single = single_under(1, bodies().single());
  CHECK(chain.top_m.x() == Approx(single.top_m.x()).epsilon(kRigidCuts));
  CHECK(chain.rotation_rad == Approx(single.rotation_rad).epsilon(kRigidCuts));
  CHECK(chain.base_moment_Nm == Approx(single.base_moment_Nm).epsilon(kRigidCuts));

  const Settings weightless = {"solver.gravity=['0 gn', '0 gn', '0 gn']"};
  const auto chain_modes =
      multibody::system_modes(read("pendulum_chain", bodies().chain(), weightless).model);
  const auto single_modes =
      multibody::system_modes(read("pendulum", bodies().single(), weightless).model);
  for (std::size_t k = 0; k < 2; ++k) {
    CAPTURE(k);
    CHECK(chain_modes.at(k).frequency_Hz ==
          Approx(single_modes.at(k).frequency_Hz).epsilon(2 * kRigidCuts));
  }
}

TEST_CASE("discs as sections between rigid plates deflect as the chain of modal bodies") {
  const auto formulation =
      GENERATE(multibody::Formulation::descriptor, multibody::Formulation::recursive);
  const auto compare = [&](int load_lbf, double tolerance) {
    CAPTURE(load_lbf);
    const Rest chain = chain_under(load_lbf);
    const Rest sections = sections_under(load_lbf, formulation);
    CHECK(sections.top_m.x() == Approx(chain.top_m.x()).epsilon(tolerance));
    CHECK(sections.top_m.z() == Approx(chain.top_m.z()).epsilon(tolerance));
    CHECK(sections.rotation_rad == Approx(chain.rotation_rad).epsilon(tolerance));
  };
  compare(1, 1e-3);
  // A modal body moves its top straight ahead, a section along an arc (tests/multibody).
  compare(100, 2e-2);
}

TEST_CASE("a section between two files of modes relaxes from the one stiffness to the other") {
  // 1200 psi and 0.49 with the shear modulus multiplied by 0.39 and the bulk modulus unchanged.
  const Bodies slow(
      " --set geometry.materials.butyl.youngs_modulus='469.84 psi'"
      " --set geometry.materials.butyl.poissons_ratio=0.496084");
  const auto section_of = [&](const std::string& relaxation) {
    const TemporaryFolder folder;
    const std::string text =
        "[solver]\nend_time = \"1 s\"\n[[body]]\nname = \"ground\"\nkind = \"ground\"\n" +
        testing::origin_marker_text("ground", "top") + testing::box_text("plate", "at") +
        "[[section]]\nname = \"disc\"\nlower = \"ground.top\"\nupper = \"plate.at\"\n"
        "modes_file = \"" +
        bodies().file_of("disc_4") + "\"\nbase = \"to_disc_3\"\ntop = \"top\"\n" + relaxation;
    return read_model_file(testing::write_test_file(folder / "section.toml", text).string(), {})
        .model.forces.of<multibody::Section>()
        .front();
  };
  const std::string slow_file = "slow_modes_file = \"" + slow.file_of("disc_4") + "\"\n";
  const multibody::Section elastic = section_of("");
  const multibody::Section relaxing = section_of(
      slow_file + "relaxation_times = [\"29 ms\", \"1 s\"]\nrelaxation_shares = [0.3, 0.1]\n");
  REQUIRE(relaxing.branches.size() == 2);
  CHECK(relaxing.branches[0].relaxation_time_s == Approx(0.029));
  const auto& first = relaxing.branches[0].stiffness;
  const auto& second = relaxing.branches[1].stiffness;
  CHECK((relaxing.stiffness + first + second - elastic.stiffness).norm() <
        1e-12 * elastic.stiffness.norm());
  CHECK((first - 3 * second).norm() < 1e-12 * first.norm());
  // Nearly incompressible, so that shear decides even the bending of a bonded disc.
  CHECK(relaxing.stiffness(0, 0) / elastic.stiffness(0, 0) == Approx(0.39).epsilon(0.01));
  const double axial = relaxing.stiffness(2, 2) / elastic.stiffness(2, 2);
  CHECK(axial > 0.391);
  CHECK(axial < 0.5);
}

TEST_CASE("at 100 lbf the stiffened body comes nearer to the chain than the linear one") {
  const Rest chain = chain_under(100);
  const Rest linear = single_under(100, bodies().published(false));
  const Rest stiffened = single_under(100, bodies().published(true));
  CHECK(linear.top_m.z() - chain.top_m.z() > 3e-3);
  CHECK(std::abs(stiffened.top_m.z() - chain.top_m.z()) <
        0.5 * std::abs(linear.top_m.z() - chain.top_m.z()));
  CHECK(std::abs(stiffened.base_moment_Nm - chain.base_moment_Nm) <
        0.5 * std::abs(linear.base_moment_Nm - chain.base_moment_Nm));
}

TEST_CASE("at 400 lbf the chain bends along an arc, shorter and stiffer than the single body") {
  constexpr int kLoad_lbf = 400;
  const double length = chain_under(0).top_m.z();
  const Rest linear = single_under(kLoad_lbf, bodies().single());
  const Rest chain = chain_under(kLoad_lbf);
  // A linear body moves its top along a straight line, proportional to the load: it stretches.
  CHECK(linear.top_m.x() ==
        Approx(kLoad_lbf * single_under(1, bodies().single()).top_m.x()).epsilon(1e-3));
  CHECK(linear.top_m.norm() > 1.3 * length);
  // The chain's top moves along an arc: lower, less far, and with less rotation, since its arm is
  // shorter.
  CHECK(chain.top_m.norm() < 1.06 * length);
  CHECK(chain.top_m.z() < 0.9 * length);
  CHECK(chain.top_m.x() < 0.8 * linear.top_m.x());
  CHECK(chain.rotation_rad < 0.9 * linear.rotation_rad);
  const double load_N = kLoad_lbf * 4.4482216152605;
  CHECK(std::abs(chain.base_moment_Nm) == Approx(load_N * chain.top_m.z()).epsilon(1e-6));
  const Rest other = chain_under(kLoad_lbf, multibody::Formulation::descriptor);
  CHECK((other.top_m - chain.top_m).norm() < 1e-9 * length);
}

TEST_CASE("generalised-alpha throws the chain as the explicit method does, in far fewer steps") {
  const auto thrown = [](multibody::Integrator integrator, double tolerance) {
    ModelFile file = read("pendulum_chain", bodies().chain(), {});
    REQUIRE(file.solver.integrator == multibody::Integrator::generalised_alpha);
    file.solver.integrator = integrator;
    file.solver.relative_tolerance = tolerance;
    return multibody::simulate_from_equilibrium(file.model, file.solver, {0.05, 1e-3});
  };
  const History exact = thrown(multibody::Integrator::dormand_prince, 1e-6);
  const History found = thrown(multibody::Integrator::generalised_alpha, 1e-7);
  CHECK(20 * found.statistics.evaluations < exact.statistics.evaluations);
  const auto check_same = [](const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
    CHECK((a - b).cwiseAbs().maxCoeff() < 1e-3 * b.cwiseAbs().maxCoeff());
  };
  check_same(found.marker("head.cg").position_m, exact.marker("head.cg").position_m);
  check_same(found.marker("head.cg").acceleration_m_s2, exact.marker("head.cg").acceleration_m_s2);
  // Reactions of every joint agree, though the stiff modes that carry them are not resolved.
  for (const multibody::JointHistory& joint : exact.joints) {
    CAPTURE(joint.name);
    check_same(found.joint(joint.name).force_N, joint.force_N);
    check_same(found.joint(joint.name).moment_Nm, joint.moment_Nm);
  }
}
