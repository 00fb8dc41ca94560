// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include <catch2/catch.hpp>

#include "fe_modal/analysis/modal_analysis.h"
#include "fe_modal/analysis/prestress.h"
#include "fe_modal/analysis/static_analysis.h"
#include "fe_modal/system/supports.h"
#include "geometry/foundation/temporary_folder.h"
#include "mesher/exchange/inp_writer.h"
#include "tests/support/block_mesh.h"
#include "tests/support/calculix.h"
#include "tests/support/element_meshes.h"
#include "tests/support/files.h"

namespace flexneck::fe_modal {
namespace {

/// Relative rounding of CalculiX's output, which has seven digits.
constexpr double kPrinted = 1e-6;

/// A thin tapered plate of 20-node hexahedra, clamped at one end.
mesher::Mesh plate() {
  testing::BlockMesh block = testing::box({3, 1, 5}, {1, 1, 1}, {"alloy", 7e10, 0.3, 2700});
  block.position = [](const Eigen::Vector3d& p) -> Eigen::Vector3d {
    return {0.2 * (p.x() - 0.5) * (1 - 0.3 * p.z()), 0.002 * (p.y() - 0.5), 0.3 * p.z()};
  };
  return testing::with_kind(block.make(), mesher::ElementKind::hex20);
}

std::vector<std::array<double, 3>> rows_of(const Eigen::Matrix3Xd& columns) {
  std::vector<std::array<double, 3>> rows;
  for (const auto& column : columns.colwise()) rows.push_back({column[0], column[1], column[2]});
  return rows;
}

/// Rows of numbers in a .dat file after the line with a text, up to the next text.
std::vector<std::vector<double>> printed_rows(const std::string& dat, const std::string& title) {
  std::istringstream file(dat.substr(std::min(dat.find(title), dat.size())));
  std::vector<std::vector<double>> rows;
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::istringstream numbers(line);
    std::vector<double> row;
    for (double number = 0; numbers >> number;) row.push_back(number);
    if (row.empty() && !rows.empty()) break;
    if (!row.empty()) rows.push_back(row);
  }
  return rows;
}

/// Largest difference of the stresses at the integration points, which are identified by position,
/// since CalculiX has another order.
double stress_difference(const PointStresses& ours, const std::string& dat) {
  const auto stresses = printed_rows(dat, "stresses");
  const auto places = printed_rows(dat, "global coordinates");
  REQUIRE(stresses.size() == static_cast<std::size_t>(ours.stress_Pa.cols()));
  REQUIRE(places.size() == stresses.size());
  double largest = 0;
  for (std::size_t k = 0; k < stresses.size(); ++k) {
    const Eigen::Vector3d place(places[k].at(2), places[k].at(3), places[k].at(4));
    Eigen::Index nearest = 0;
    REQUIRE((ours.positions_m.colwise() - place).colwise().norm().minCoeff(&nearest) < 1e-6);
    const Stress expected = Eigen::Map<const Stress>(stresses[k].data() + 2);
    largest = std::max(largest, (ours.stress_Pa.col(nearest) - expected).cwiseAbs().maxCoeff());
  }
  return largest;
}

}  // namespace

TEST_CASE("CalculiX finds a loaded plate's stresses, buckling load and prestressed frequencies",
          "[ccx]") {
  const mesher::Mesh mesh = plate();
  ModalOptions options;
  options.mode_count = 6;
  options.formulation.of_others = Formulation::displacement;
  options.fixed_set = "bottom";
  // The plate is loaded in its plane, so that a small stress matters. For *FREQUENCY CalculiX adds
  // the stiffness of the displacements to that of the stresses, which changes frequencies by the
  // order of the strains, here 1e-6; for *BUCKLE it does not.
  FaceLoad tip{"top"};
  tip.force_N = {3, 0, -20};
  tip.moment_Nm = {0, 0.2, 0};
  SupportLoad support{"bottom"};
  support.rotation_rad = {0, 1e-5, 0};
  options.prestress = {{"weight", GravityLoad{{0, 0, -9.81}}},
                       {"tip", tip},
                       {"pressure", PressureLoad{"top", 1e4}},
                       {"turn", support}};
  const StaticSolution solution = analyse_static(mesh, options, options.prestress, {});

  const TemporaryFolder folder;
  const std::filesystem::path deck = folder / "plate.inp";
  mesher::InpOptions deck_options{.reduced = {}, .fixed = {"bottom"}, .mode_count = 6};
  deck_options.static_step = {rows_of(solution.applied_N),
                              rows_of(support_displacements(mesh, options, options.prestress)),
                              true};
  mesher::write_inp(deck, mesh, deck_options);
  std::string text = testing::bytes_of(deck);
  const std::string step = "*STATIC\n";
  text.insert(text.find(step) + step.size(), "*EL PRINT,ELSET=block\nS,COORD\n");
  std::ofstream(deck) << text;
  const std::vector<double> expected_Hz = testing::calculix_frequencies(deck);

  const PointStresses& at_points = solution.at_points.at(0);
  CHECK(stress_difference(at_points, testing::bytes_of(folder / "plate.dat")) <
        kPrinted * at_points.stress_Pa.cwiseAbs().maxCoeff());
  const Eigen::VectorXd found_Hz = analyse_modes(mesh, options, {}).frequencies_Hz;
  REQUIRE(expected_Hz.size() == 6);
  for (Eigen::Index k = 0; k < 6; ++k)
    CHECK(found_Hz[k] == Approx(expected_Hz[static_cast<std::size_t>(k)]).epsilon(kPrinted));
  const std::string static_part = text.substr(0, text.find("*STEP,PERTURBATION"));
  std::string buckling = static_part;
  buckling.replace(buckling.find(step), step.size(), "*BUCKLE\n1\n");
  std::ofstream(folder / "buckling.inp") << buckling;
  const testing::CommandOutcome outcome = testing::run_shell(
      "cd '" + folder.path().string() + "' && OMP_NUM_THREADS=1 ccx -i buckling");
  INFO(outcome.text);
  const auto factors =
      printed_rows(testing::bytes_of(folder / "buckling.dat"), "B U C K L I N G   F A C T O R");
  REQUIRE(!factors.empty());
  Model stressed(mesh, options);
  add_prestress(stressed, {});
  const auto factor = buckling_factor(stressed);
  REQUIRE(factor);
  CHECK(*factor == Approx(factors.front().at(1)).epsilon(kPrinted));
  // The loads have an effect: without them the first frequency is another.
  ModalOptions unloaded = options;
  unloaded.prestress.clear();
  CHECK(std::abs(analyse_modes(mesh, unloaded, {}).frequencies_Hz[0] / found_Hz[0] - 1) > 0.02);
}

}  // namespace flexneck::fe_modal
