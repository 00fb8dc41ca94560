// SPDX-License-Identifier: GPL-3.0-or-later
// The shipped models of the neck as a chain of four bodies, against the neck as one body, on the
// coarsest neck.
#include <cmath>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "geometry/foundation/temporary_folder.h"
#include "multibody/analysis/linearisation.h"
#include "multibody/simulation/simulation.h"
#include "pipeline/model/model_file.h"
#include "tests/support/coarse_neck.h"
#include "tests/support/flexneck_command.h"

using namespace flexneck;
using namespace flexneck::pipeline;
using multibody::History;
using Settings = std::vector<std::string>;

namespace {

/// The neck and its pieces, made once.
class Bodies {
 public:
  Bodies() {
    const std::string more = " " + std::string(FLEXNECK_SOURCE_DIR) +
                             "/pipeline/studies/hybrid3_chain.toml -q -o " +
                             folder_.path().string() + testing::kCoarseNeck;
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
  /// With its whole static compliance.
  Settings single() const {
    return {"body.neck.modes_file=" + (folder_ / "modes.h5").string(),
            "body.neck.modes=['normal', 'residual']"};
  }
  /// With the paper's four modes, as shipped.
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
  return read_model_file(std::string(FLEXNECK_SOURCE_DIR) + "/pipeline/models/" + model + ".toml",
                         settings);
}

/// At rest under the forward load.
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

Rest single_under(int load_lbf, const Settings& settings) {
  return rest_under(load_lbf, "static_test", settings, "neck.top",
                    multibody::Formulation::recursive);
}

/// What the chain's rigid cuts take from the neck's compliance, at most.
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
  // A linear body draws its top along a straight line, in proportion to the load: it stretches.
  CHECK(linear.top_m.x() ==
        Approx(kLoad_lbf * single_under(1, bodies().single()).top_m.x()).epsilon(1e-3));
  CHECK(linear.top_m.norm() > 1.3 * length);
  // The chain's moves along an arc: lower, less far, and less turned, since its arm is shorter.
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
  // Reactions of every joint, though the stiff modes that carry them are not followed.
  for (const multibody::JointHistory& joint : exact.joints) {
    CAPTURE(joint.name);
    check_same(found.joint(joint.name).force_N, joint.force_N);
    check_same(found.joint(joint.name).moment_Nm, joint.moment_Nm);
  }
}
