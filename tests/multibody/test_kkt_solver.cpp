// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <optional>
#include <vector>

#include <Eigen/LU>
#include <catch2/catch.hpp>

#include "multibody/descriptor/kkt_solver.h"
#include "multibody/joints/joint_kinds.h"
#include "tests/support/point_mass_body.h"

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using flexneck::testing::RandomNumbers;
using namespace flexneck::multibody;

namespace {

constexpr std::size_t kPrescribed = JointPlace::kNoBody;

/// The same system as a dense matrix.
struct Dense {
  MatrixXd matrix;

  Dense(KktSolver& solver, const std::vector<Index>& sizes, const std::vector<JointPlace>& places,
        RandomNumbers& random) {
    const Index nv = solver.velocity_count();
    matrix.setZero(nv + solver.constraint_count(), nv + solver.constraint_count());
    for (std::size_t b = 0; b < sizes.size(); ++b) {
      MatrixXd factor(sizes[b], sizes[b]);
      random.fill(factor);
      const MatrixXd mass =
          factor * factor.transpose() + 0.1 * MatrixXd::Identity(sizes[b], sizes[b]);
      solver.set_mass(b, mass);
      matrix.block(solver.body_offset(b), solver.body_offset(b), sizes[b], sizes[b]) = mass;
    }
    for (std::size_t k = 0; k < places.size(); ++k) {
      const auto size = [&](std::size_t body) { return body == kPrescribed ? 0 : sizes[body]; };
      Joint joint;
      joint.kind = places[k].rows == 3 ? &kSphericalJoint : &kFixedJoint;
      JointRows rows(joint, size(places[k].body_i), size(places[k].body_j));
      for (TransposedRows* B : {&rows.B_i, &rows.B_j})
        for (Index c = 0; c < places[k].rows; ++c)
          for (Index r = 0; r < B->rows(); ++r) (*B)(r, c) = random.next();
      solver.set_rows(k, rows);
      place(solver, k, places[k].body_i, rows.B_i.leftCols(places[k].rows));
      place(solver, k, places[k].body_j, rows.B_j.leftCols(places[k].rows));
    }
  }

  void place(const KktSolver& solver, std::size_t joint, std::size_t body, const MatrixXd& B) {
    if (body == kPrescribed) return;
    const Index row = solver.velocity_count() + solver.joint_offset(joint);
    const Index column = solver.body_offset(body);
    matrix.block(row, column, B.cols(), B.rows()) += B.transpose();
    matrix.block(column, row, B.rows(), B.cols()) += B;
  }
};

}  // namespace

TEST_CASE("elimination body by body solves the whole system") {
  RandomNumbers random(41);
  // A chain on a prescribed body, a branch, and a loop closed between its ends; all forms of
  // envelopes.
  const std::vector<Index> sizes = {6, 10, 6, 8};
  const std::vector<JointPlace> places = {{kPrescribed, 0, 3}, {0, 1, 6}, {1, 2, 3},
                                          {3, 0, 6},           {2, 3, 3}, {2, kPrescribed, 3}};
  KktSolver solver(sizes, places, VectorXd::Ones(30));
  const Dense dense(solver, sizes, places, random);
  solver.factorise();
  CHECK(solver.redundant_rows().empty());
  VectorXd r = random.vector(solver.velocity_count());
  VectorXd s = random.vector(solver.constraint_count());
  VectorXd right(r.size() + s.size());
  right << r, s;
  const VectorXd expected = dense.matrix.fullPivLu().solve(right);
  solver.solve(r, s);
  VectorXd found(right.size());
  found << r, s;
  // Condition numbers of such random matrices are about 1e4.
  CHECK((found - expected).norm() < 1e-11 * expected.norm());
}

TEST_CASE("rows that repeat others are found and left out") {
  const std::vector<JointPlace> places = {{kPrescribed, 0, 3}, {0, 1, 6}, {0, 1, 3}};
  KktSolver solver({6, 6}, places, VectorXd::Ones(12));
  for (std::size_t b = 0; b < 2; ++b) solver.set_mass(b, MatrixXd::Identity(6, 6));
  Joint fixed;
  for (std::size_t k = 0; k < places.size(); ++k) {
    fixed.kind = places[k].rows == 6 ? &kFixedJoint : &kSphericalJoint;
    JointRows rows(fixed, places[k].body_i == kPrescribed ? 0 : 6, 6);
    for (Index r = 0; r < places[k].rows; ++r) {
      rows.B_j(r, r) = -1;
      if (rows.B_i.rows() > 0) rows.B_i(r, r) = 1;
    }
    solver.set_rows(k, rows);
  }
  solver.factorise();
  const auto redundant = solver.redundant_rows();
  REQUIRE(redundant.size() == 3);
  for (Index r = 0; r < 3; ++r) {
    CHECK(redundant[static_cast<std::size_t>(r)].joint == 2);
    CHECK(redundant[static_cast<std::size_t>(r)].row == r);
  }
  // Loads along the first three axes go through the prescribed joint; its multipliers equal them.
  VectorXd r = VectorXd::LinSpaced(12, 1, 12);
  VectorXd s = VectorXd::Zero(12);
  solver.solve(r, s);
  CHECK(s.tail(3).norm() == 0);
  CHECK(r.head(3).norm() < 1e-14);
  CHECK((r.head(6) - r.tail(6)).norm() < 1e-14);
  CHECK((s.head(3) + Eigen::Vector3d(1 + 7, 2 + 8, 3 + 9)).norm() < 1e-13);
}

TEST_CASE(
    "masses that differ by fourteen orders leave all digits, and rank is decided without them") {
  // A heavy body on a prescribed one; a light one connects another heavy one to it.
  using Extended = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
  RandomNumbers random(43);
  const std::vector<JointPlace> places = {{kPrescribed, 0, 3}, {0, 1, 6}, {1, 2, 6}};
  KktSolver solver({6, 6, 6}, places, VectorXd::Ones(18));
  Extended matrix = Extended::Zero(33, 33);
  for (std::size_t b = 0; b < 3; ++b) {
    const MatrixXd mass = (b == 1 ? 1e-11 : 1e3) * MatrixXd::Identity(6, 6);
    solver.set_mass(b, mass);
    matrix.block(solver.body_offset(b), solver.body_offset(b), 6, 6) = mass.cast<long double>();
  }
  for (std::size_t k = 0; k < places.size(); ++k) {
    Joint joint;
    joint.kind = places[k].rows == 6 ? &kFixedJoint : &kSphericalJoint;
    JointRows rows(joint, places[k].body_i == kPrescribed ? 0 : 6, 6);
    for (TransposedRows* B : {&rows.B_i, &rows.B_j})
      for (Index c = 0; c < places[k].rows; ++c)
        for (Index r = 0; r < B->rows(); ++r) (*B)(r, c) = random.next();
    solver.set_rows(k, rows);
    const auto add = [&](std::size_t body, const TransposedRows& B) {
      if (body == kPrescribed) return;
      const Index row = 18 + solver.joint_offset(k);
      matrix.block(row, solver.body_offset(body), places[k].rows, 6) +=
          B.leftCols(places[k].rows).transpose().cast<long double>();
      matrix.block(solver.body_offset(body), row, 6, places[k].rows) +=
          B.leftCols(places[k].rows).cast<long double>();
    };
    add(places[k].body_i, rows.B_i);
    add(places[k].body_j, rows.B_j);
  }
  solver.factorise();
  CHECK(solver.redundant_rows().empty());
  CHECK(!solver.is_well_scaled());
  VectorXd r = random.vector(18);
  VectorXd s = random.vector(15);
  Extended right(33, 1);
  right << r.cast<long double>(), s.cast<long double>();
  const VectorXd expected = matrix.fullPivLu().solve(right).cast<double>();
  solver.solve(r, s);
  for (Index body = 0; body < 3; ++body)
    CHECK((r - expected.head(18)).segment<6>(6 * body).norm() <
          1e-11 * expected.segment<6>(6 * body).norm());
  CHECK((s - expected.tail(15)).norm() < 1e-11 * expected.tail(15).norm());
}

TEST_CASE("a body whose mass matrix is not positive definite is named until all are again") {
  KktSolver solver({2, 2}, {}, VectorXd::Ones(4));
  const auto factorise = [&](double of_first, double of_second) {
    solver.set_mass(0, (MatrixXd(2, 2) << 2, 1, 1, of_first).finished());
    solver.set_mass(1, (MatrixXd(2, 2) << 2, 1, 1, of_second).finished());
    solver.factorise();
    return solver.indefinite_body();
  };
  CHECK(factorise(1, 1) == std::nullopt);
  CHECK(factorise(1, 0.4) == std::size_t{1});
  // NaN does not count as indefinite, and does not change the last report.
  const double nan = std::nan("");
  CHECK(factorise(nan, nan) == std::size_t{1});
  CHECK(factorise(0.4, 1) == std::size_t{0});
  CHECK(factorise(1, 1) == std::nullopt);
}
