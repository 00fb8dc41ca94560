// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "fe_modal/analysis/sensitivity.h"
#include "geometry/foundation/error.h"
#include "mesher/mesh/mesh_summary.h"
#include "mesher/mesh/node_velocity.h"
#include "tests/support/block_mesh.h"
#include "tests/support/element_meshes.h"
#include "tests/support/finite_differences.h"

namespace flexneck::fe_modal {
namespace {

using Catch::Matchers::Contains;
using testing::first_derivative;

/// Relative error of differences of order 6 between solutions of the eigenproblem.
constexpr double kDifferences = 1e-6;
constexpr double kLength = 0.3;
const mesher::Material kSoft{"rubber", 8.3e6, 0.49, 950};
const mesher::Material kHard{"steel", 2.1e8, 0.3, 7850};

/// A block without any symmetry, of two materials.
/// @param t widens, shears and lengthens it, differently at each node
mesher::Mesh block(double t) {
  testing::BlockMesh box = testing::box({1, 1, 1}, {1, 1, 1}, kSoft);
  box.slices = {{"pad", 1, kSoft}, {"plate", 1, kHard}};
  box.position = [t](const Eigen::Vector3d& p) -> Eigen::Vector3d {
    const Eigen::Vector3d change(p.y() * p.z(), p.x() * p.x() - p.z(), p.x() + p.z());
    return kLength * testing::distorted(p).cwiseProduct(Eigen::Vector3d(0.4, 0.5, 1)) + t * change;
  };
  return box.make();
}

ModalOptions options_of_block() {
  ModalOptions options;
  options.mode_count = 5;
  options.fixed_set = "bottom";
  options.interfaces = {{"tip", "top", {0.01, -0.02, 0.32}}};
  Eigen::Matrix3d inertia;
  inertia << 0.020, 0.002, -0.001, 0.002, 0.024, 0.003, -0.001, 0.003, 0.018;
  options.attachments = {{"head", "tip", 4.5, {0.03, 0.01, 0.36}, inertia}};
  return options;
}

/// Frequencies, frequencies with the body attached, stiffnesses, and mass.
Eigen::VectorXd values_of(const mesher::Mesh& mesh, const ModalOptions& options) {
  const ModalBody body = analyse_modes(mesh, options, {});
  const Eigen::Index modes = body.mode_count();
  const bool is_attached = !body.attached.empty();
  const Eigen::Index attached = is_attached ? body.attached[0].frequencies_Hz.size() : 0;
  Eigen::VectorXd values(modes + attached + 7);
  values.head(modes) = body.frequencies_Hz;
  if (is_attached) values.segment(modes, attached) = body.attached[0].frequencies_Hz;
  values.segment<6>(modes + attached) =
      body.interface("tip").response->compliance.diagonal().cwiseInverse();
  values.tail<1>()[0] = body.invariants.mass;
  return values;
}

/// Velocities of the nodes.
/// @param width step in t
Eigen::Matrix3Xd velocity_of(const std::function<mesher::Mesh(double)>& mesh_at, double width) {
  return mesher::node_velocity(mesh_at(0), mesh_at(-width / 2), mesh_at(width / 2), width);
}

Sensitivities analyse(const mesher::Mesh& mesh, const ModalOptions& options,
                      std::vector<DesignParameter> parameters) {
  AnalysisFields fields;
  const ModalBody body = analyse_modes(mesh, options, {}, nullptr, {}, &fields);
  return sensitivities(mesh, options, body, fields, std::move(parameters));
}

std::vector<DesignParameter> all_materials(const mesher::Mesh& mesh) {
  std::vector<DesignParameter> parameters;
  for (std::size_t m = 0; m < mesh.materials.size(); ++m) {
    const mesher::Material& material = mesh.materials[m];
    using enum MaterialConstant;
    parameters.push_back({material.name + ".youngs_modulus", "Pa", material.youngs_modulus_Pa,
                          MaterialParameter{m, youngs_modulus}});
    parameters.push_back({material.name + ".poissons_ratio", "1", material.poissons_ratio,
                          MaterialParameter{m, poissons_ratio}});
    parameters.push_back({material.name + ".density", "kg/m^3", material.density_kg_m3,
                          MaterialParameter{m, density}});
  }
  return parameters;
}

double& constant_of(mesher::Material& material, MaterialConstant constant) {
  switch (constant) {
    case MaterialConstant::youngs_modulus:
      return material.youngs_modulus_Pa;
    case MaterialConstant::poissons_ratio:
      return material.poissons_ratio;
    case MaterialConstant::density:
      break;
  }
  return material.density_kg_m3;
}

void check_same(const Eigen::VectorXd& found, const Eigen::VectorXd& expected,
                const Eigen::VectorXd& scale) {
  REQUIRE(found.size() == expected.size());
  for (Eigen::Index k = 0; k < found.size(); ++k) {
    INFO("quantity " << k << ": " << found[k] << ", expected " << expected[k]);
    CHECK(std::abs(found[k] - expected[k]) < kDifferences * scale[k]);
  }
}

void check_all_parameters(const std::function<mesher::Mesh(double)>& mesh_at,
                          const ModalOptions& options) {
  const mesher::Mesh mesh = mesh_at(0);
  std::vector<DesignParameter> parameters = all_materials(mesh);
  const auto constants = static_cast<Eigen::Index>(parameters.size());
  parameters.push_back({"t", "m", 0.01, velocity_of(mesh_at, 1e-2)});
  const Sensitivities found = analyse(mesh, options, parameters);
  const Eigen::VectorXd values = values_of(mesh, options);
  for (Eigen::Index k = 0; k < values.size(); ++k) {
    CHECK(found.quantities[static_cast<std::size_t>(k)].value == Approx(values[k]).epsilon(1e-10));
  }
  const auto moved = [&](double t) { return values_of(mesh_at(t), options); };
  check_same(found.derivatives.rightCols<1>(), first_derivative(moved, 4e-4),
             found.derivatives.rightCols<1>().cwiseAbs());
  for (Eigen::Index p = 0; p < constants; ++p) {
    const DesignParameter& parameter = parameters[static_cast<std::size_t>(p)];
    INFO(parameter.name);
    const auto constant = std::get<MaterialParameter>(parameter.change);
    const auto changed = [&](double t) {
      mesher::Mesh other = mesh;
      constant_of(other.materials[constant.material], constant.constant) += t * parameter.value;
      return values_of(other, options);
    };
    // The difference of quantities that hardly depend on a constant is the rounding of their
    // values: a part in 1e12 over the step. Poisson's ratio must not reach 1/2.
    const double step = constant.constant == MaterialConstant::poissons_ratio ? 2e-3 : 1e-2;
    check_same(parameter.value * found.derivatives.col(p), first_derivative(changed, step),
               (parameter.value * found.derivatives.col(p)).cwiseAbs() + 1e-4 * values);
  }
}

}  // namespace

TEST_CASE("derivatives by nodes and materials are those of repeated analyses") {
  check_all_parameters(block, options_of_block());
}

TEST_CASE("so they are with a rigid interface, whose coupling moves with the nodes") {
  ModalOptions options = options_of_block();
  options.interfaces[0].is_rigid = true;
  check_all_parameters(block, options);
}

TEST_CASE("so they are with tied slits, other elements and other formulations") {
  const auto slit = [](double t) {
    const auto is_cut = [](const Eigen::Vector3d& x) {
      return x.x() > 0.06 && std::abs(x.z() - 0.1) < 1e-9;
    };
    testing::BlockMesh box = testing::box({2, 1, 2}, {1, 1, 1}, kSoft);
    box.position = [t](const Eigen::Vector3d& p) -> Eigen::Vector3d {
      return {0.1 * p.x() + t * p.x() * p.y(), 0.13 * p.y() - t * p.z(), 0.2 * p.z()};
    };
    return testing::with_slit(box.make(), 0.1, true, is_cut);
  };
  check_all_parameters(slit, options_of_block());
  const auto tetrahedra = [](double t) {
    return testing::with_kind(block(t), mesher::ElementKind::tet10);
  };
  ModalOptions options = options_of_block();
  options.formulation.of_material["steel"] = Formulation::displacement;
  options.fixed_directions = {{"top", {true, false, false}}};
  options.interfaces.clear();
  options.attachments.clear();
  const mesher::Mesh mesh = tetrahedra(0);
  const Sensitivities found =
      analyse(mesh, options, {{"t", "m", 0.01, velocity_of(tetrahedra, 1e-2)}});
  const auto moved = [&](double t) {
    return analyse_modes(tetrahedra(t), options, {}).frequencies_Hz;
  };
  const Eigen::VectorXd modes = found.derivatives.topRows(5).col(0);
  check_same(modes, first_derivative(moved, 4e-4), modes.cwiseAbs());
}

TEST_CASE("a body that grows, stiffens or gets heavier as a whole has closed forms") {
  // The closed forms are f ~ sqrt(E / rho) / L, m ~ rho L^3, force by displacement ~ E L, moment by
  // rotation ~ E L^3; the points of interfaces are fixed, so the centre of growth is there.
  const auto mesh_at = [](double t) {
    testing::BlockMesh box = testing::box({1, 1, 2}, {0.05, 0.07, kLength}, kSoft);
    const auto at_rest = box.position;
    box.position = [=](const Eigen::Vector3d& p) -> Eigen::Vector3d {
      const Eigen::Vector3d tip(0, 0, kLength);
      return tip + (1 + t) * (at_rest(p) - tip);
    };
    return box.make();
  };
  ModalOptions options = options_of_block();
  options.attachments.clear();
  options.interfaces[0].position_m = {0, 0, kLength};
  const mesher::Mesh mesh = mesh_at(0);
  std::vector<DesignParameter> parameters = all_materials(mesh);
  parameters.push_back({"size", "1", 1, velocity_of(mesh_at, 0.1)});
  const Sensitivities found = analyse(mesh, options, parameters);
  const Eigen::MatrixXd relative = found.relative();
  constexpr double kRounding = 1e-8;
  for (std::size_t q = 0; q < found.quantities.size(); ++q) {
    const Quantity& quantity = found.quantities[q];
    INFO(name_of(quantity.kind) << ' ' << quantity.name);
    Eigen::Vector3d expected(0.5, -0.5, -1);  // exponents of E, rho and size
    if (quantity.kind == QuantityKind::mass) expected = {0, 1, 3};
    if (quantity.kind == QuantityKind::static_stiffness) {
      expected = {1, 0, quantity.name.front() == 'F' ? 1.0 : 3.0};
    }
    const auto row = relative.row(static_cast<Eigen::Index>(q));
    CHECK(std::abs(row[0] - expected[0]) < kRounding);
    CHECK(std::abs(row[2] - expected[1]) < kRounding);
    CHECK(std::abs(row[3] - expected[2]) < kRounding);
  }
}

TEST_CASE("a free body has derivatives of its elastic modes and its mass only") {
  ModalOptions options = options_of_block();
  options.fixed_set.clear();
  options.attachments.clear();
  options.mode_count = 9;
  const Sensitivities found =
      analyse(block(0), options, {{"t", "m", 0.01, velocity_of(block, 1e-2)}});
  // The first two lie within 1 % of one another, so their mean is differentiated.
  const auto moved = [&](double t) -> Eigen::Vector3d {
    const Eigen::VectorXd all = analyse_modes(block(t), options, {}).frequencies_Hz;
    return {std::sqrt(all.segment<2>(6).squaredNorm() / 2), all[8],
            mesher::summarise(block(t)).mass_kg};
  };
  REQUIRE(found.quantities.size() == 5);
  const std::vector<Eigen::Index> rows = {0, 3, 4};
  const Eigen::Vector3d derivatives = found.derivatives.col(0)(rows);
  check_same(derivatives, first_derivative(moved, 4e-4), derivatives.cwiseAbs());
}

namespace {

/// A square column; the parameters widen it along x, along the diagonal, and in both directions.
mesher::Mesh column(const Eigen::Vector3d& t) {
  testing::BlockMesh box = testing::box({1, 1, 3}, {0.03, 0.03, kLength}, kHard);
  const auto at_rest = box.position;
  box.position = [=](const Eigen::Vector3d& p) -> Eigen::Vector3d {
    const Eigen::Vector3d x = at_rest(p);
    const double along = (x.x() + x.y()) / 2;
    return x + Eigen::Vector3d(t[0] * x.x() + t[1] * along + t[2] * x.x(),
                               t[1] * along + t[2] * x.y(), 0);
  };
  return box.make();
}

/// Sensitivities of the column.
/// @param directions names of parameters, 0: x, 1: diagonal, 2: both
Sensitivities of_column(const std::vector<Eigen::Index>& directions, ModalOptions& options) {
  options.mode_count = 4;
  options.fixed_set = "bottom";
  options.interfaces = {{"tip", "top", {0, 0, kLength}}};
  options.sign_interface = "tip";
  options.length_m = kLength;
  std::vector<DesignParameter> parameters;
  for (const Eigen::Index k : directions) {
    const auto mesh_at = [k](double t) { return column(t * Eigen::Vector3d::Unit(k)); };
    parameters.push_back({"t" + std::to_string(k), "1", 1, velocity_of(mesh_at, 0.1)});
  }
  return analyse(column({0, 0, 0}), options, parameters);
}

Eigen::RowVectorXd row_of(const Sensitivities& found, QuantityKind kind, int which) {
  for (std::size_t q = 0; q < found.quantities.size(); ++q) {
    if (found.quantities[q].kind == kind && which-- == 0) {
      return found.derivatives.row(static_cast<Eigen::Index>(q));
    }
  }
  FAIL("no such quantity");
  return {};
}

}  // namespace

TEST_CASE("of a double eigenvalue there are the mean's gradient and directional derivatives") {
  ModalOptions options;
  const Sensitivities found = of_column({0, 1, 2}, options);
  CHECK(found.quantities[0].kind == QuantityKind::mean_frequency);
  CHECK_THAT(found.quantities[0].name, Contains(", "));
  for (Eigen::Index p = 0; p < 3; ++p) {
    INFO("parameter " << p);
    const auto pair_at = [&](double t) -> Eigen::Vector2d {
      return analyse_modes(column(t * Eigen::Vector3d::Unit(p)), options, {})
          .frequencies_Hz.head<2>();
    };
    const auto mean = [&](double t) { return std::sqrt(pair_at(t).squaredNorm() / 2); };
    const double scale = found.derivatives.col(p).cwiseAbs().maxCoeff();
    CHECK(std::abs(row_of(found, QuantityKind::mean_frequency, 0)[p] -
                   first_derivative(mean, 4e-3)) < kDifferences * scale);
    // A branch that is the lower one for positive t is the upper one for negative t.
    const auto lower = [&](double t) { return t > 0 ? pair_at(t)[0] : pair_at(t)[1]; };
    const auto upper = [&](double t) { return t > 0 ? pair_at(t)[1] : pair_at(t)[0]; };
    CHECK(std::abs(row_of(found, QuantityKind::directional, 0)[p] - first_derivative(lower, 4e-3)) <
          kDifferences * scale);
    CHECK(std::abs(row_of(found, QuantityKind::directional, 1)[p] - first_derivative(upper, 4e-3)) <
          kDifferences * scale);
  }
  // The diagonal couples the modes along x and y, so that there is no gradient of each.
  CHECK(std::none_of(found.quantities.begin(), found.quantities.end(), [](const Quantity& each) {
    return each.kind == QuantityKind::symmetry_class;
  }));
  CHECK_THAT(found.notes.at(0), Contains("coupled by the parameters"));
}

TEST_CASE("modes of different symmetry have gradients of their own where nothing couples them") {
  ModalOptions options;
  const Sensitivities found = of_column({0, 2}, options);
  CHECK_THAT(found.notes.at(0), Contains("by symmetry class"));
  const Eigen::RowVectorXd along_x = row_of(found, QuantityKind::symmetry_class, 0);
  const Eigen::RowVectorXd along_y = row_of(found, QuantityKind::symmetry_class, 1);
  // For slender columns f is proportional to the width in the direction of motion; the slenderness
  // is 10 : 1, with shear.
  const double f_Hz = found.quantities[0].value;
  CHECK(along_x[0] / f_Hz == Approx(1).margin(0.05));
  CHECK(along_y[0] / f_Hz == Approx(0).margin(0.05));
  CHECK(along_x[1] == Approx(along_y[1]).epsilon(1e-6));
  CHECK(along_x[1] == Approx(along_x[0] + along_y[0]).epsilon(1e-6));
}

TEST_CASE("sensitivities are refused where there are no eigenvectors or motions are not averages") {
  ModalOptions options = options_of_block();
  const auto refused = [&] { return analyse(block(0), options, all_materials(block(0))); };
  options.interfaces[0].is_rigid = true;
  options.interfaces.push_back({"seat", "top", {0, 0, kLength}});
  CHECK_THROWS_WITH(refused(), Contains("'seat' shares nodes with the rigid interface 'tip'"));
  options = options_of_block();
  options.basis = BasisKind::craig_bampton;
  CHECK_THROWS_WITH(refused(), Contains("Craig-Bampton"));
}

}  // namespace flexneck::fe_modal
