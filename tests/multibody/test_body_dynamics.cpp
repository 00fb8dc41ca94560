// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <functional>
#include <numbers>

#include <catch2/catch.hpp>

#include "multibody/descriptor/body_dynamics.h"
#include "multibody/numerics/rotation.h"
#include "tests/support/finite_differences.h"
#include "tests/support/marker_motion.h"
#include "tests/support/point_mass_body.h"

// The reference is a Lagrangian that knows only the positions of the body's points. Coordinates are
// z = (x, phi, a) with the body's rotation A0 exp(~phi). At phi = 0, and only there, zdot is V =
// (xdot, w, adot) and zddot is Vdot (the right Jacobian and its rate applied to phidot are the
// identity and zero), and a variation of phi is dpi. So at phi = 0 Lagrange's equations
//   d/dt dL/dzdot - dL/dz = 0   must read   M Vdot - u = 0.
// With stress stiffening points have second-order displacements too, whose velocity counts relative
// to that of the undeformed body only (section 3a).

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using flexneck::testing::first_derivative;
using flexneck::testing::make_point_mass_body;
using flexneck::testing::PointMassBody;
using flexneck::testing::RandomNumbers;
using flexneck::testing::turned;
using namespace flexneck::multibody;

namespace {

/// Step of three nested differences of order 6, which leave about 1e-10 of the terms' size.
constexpr double kStep = 1e-2;
constexpr double kTolerance = 1e-8;

/// The body's points on a frame with orientation A0 exp(~phi).
class Points {
 public:
  Points(const PointMassBody& body, const Matrix3d& A0, bool stiffens = false)
      : body_(body), A0_(A0), stiffens_(stiffens) {}

  Vector3d position(Index k, const VectorXd& z) const {
    return z.head<3>() + A0_ * turned(z.segment<3>(3)) * body_.point(k, z.tail(z.size() - 6));
  }
  Vector3d undeformed(Index k, const VectorXd& z) const {
    return z.head<3>() + A0_ * turned(z.segment<3>(3)) * body_.body.nodes_m.col(k);
  }
  Vector3d second_order(Index k, const VectorXd& z) const {
    return A0_ * turned(z.segment<3>(3)) * body_.second_order(k, z.tail(z.size() - 6));
  }

  double kinetic_energy(const VectorXd& z, const VectorXd& zdot) const {
    double energy = 0;
    for (Index k = 0; k < body_.point_count(); ++k) {
      const Vector3d velocity =
          first_derivative([&](double t) { return position(k, z + t * zdot); }, kStep);
      energy += 0.5 * body_.masses_kg[k] * velocity.squaredNorm();
      if (!stiffens_) continue;
      const auto rate_of = [&](auto part) {
        return first_derivative([&](double t) { return (this->*part)(k, z + t * zdot); }, kStep);
      };
      energy +=
          body_.masses_kg[k] * rate_of(&Points::undeformed).dot(rate_of(&Points::second_order));
    }
    return energy;
  }

  double potential_energy(const VectorXd& z, const Vector3d& gravity) const {
    double energy = 0;
    for (Index k = 0; k < body_.point_count(); ++k) {
      energy -= body_.masses_kg[k] * gravity.dot(position(k, z));
      if (stiffens_) energy -= body_.masses_kg[k] * gravity.dot(second_order(k, z));
    }
    for (Index l = 0; l < z.size() - 6; ++l) {
      const double omega = 2 * std::numbers::pi * body_.body.frequencies_Hz[l];
      double stretch = z[6 + l];
      if (stiffens_)
        stretch -= body_.modal_share(static_cast<std::size_t>(l), z.tail(z.size() - 6));
      energy += 0.5 * omega * omega * stretch * stretch;
    }
    return energy;
  }

 private:
  const PointMassBody& body_;
  Matrix3d A0_;
  bool stiffens_;
};

using Lagrangian = std::function<double(const VectorXd& z, const VectorXd& zdot)>;

/// Computes d/dt dL/dzdot - dL/dz. Central differences over zdot are exact: L is quadratic in it.
VectorXd lagrange(const Lagrangian& L, const VectorXd& z, const VectorXd& zdot,
                  const VectorXd& zddot) {
  VectorXd result(z.size());
  for (Index i = 0; i < z.size(); ++i) {
    const VectorXd unit = VectorXd::Unit(z.size(), i);
    const auto momentum = [&](double t) {
      const VectorXd at = z + t * zdot + t * t / 2 * zddot;
      const VectorXd rate = zdot + t * zddot;
      return (L(at, rate + unit) - L(at, rate - unit)) / 2;
    };
    const auto along = [&](double t) { return L(z + t * unit, zdot); };
    result[i] = first_derivative(momentum, kStep) - first_derivative(along, kStep);
  }
  return result;
}

struct Fixture {
  explicit Fixture(int modes, bool stiffens = false)
      : points(make_point_mass_body(11, modes)),
        constants(DeformableBody{points.body, VectorXd::Zero(modes), {}, stiffens}),
        terms(constants),
        A(RandomNumbers(5).rotation().toRotationMatrix()),
        truth(points, A, stiffens) {
    RandomNumbers random(6);
    z = VectorXd::Zero(6 + modes);
    z.head<3>() = random.vector();
    z.tail(modes) = 0.1 * random.vector(modes);  // a few centimetres: far from small
    terms.x = z.head<3>();
    terms.A = A;
    terms.a = z.tail(modes);
    update_configuration(constants, terms);
  }

  VectorXd right_hand_side(const VectorXd& V, const Vector3d& gravity) {
    update_right_hand_side(constants, gravity, V, terms);
    return terms.u;
  }

  PointMassBody points;
  BodyConstants constants;
  BodyTerms terms;
  Matrix3d A;
  Points truth;
  VectorXd z;
};

double relative_error(const VectorXd& found, const VectorXd& expected) {
  return (found - expected).norm() / expected.norm();
}

}  // namespace

TEST_CASE("the mass matrix of a deformed body is that of its points") {
  Fixture body(3, GENERATE(false, true));
  const Lagrangian kinetic = [&](const VectorXd& z, const VectorXd& zdot) {
    return body.truth.kinetic_energy(z, zdot);
  };
  const VectorXd rest = VectorXd::Zero(body.z.size());
  for (Index i = 0; i < body.z.size(); ++i) {
    const VectorXd expected = lagrange(kinetic, body.z, rest, VectorXd::Unit(body.z.size(), i));
    CHECK(relative_error(body.terms.mass.col(i), expected) < kTolerance);
  }
  CHECK((body.terms.mass - body.terms.mass.transpose()).norm() < 1e-15);
}

TEST_CASE("centrifugal, Coriolis and gyroscopic terms follow from the points' kinetic energy") {
  Fixture body(3, GENERATE(false, true));
  const Lagrangian kinetic = [&](const VectorXd& z, const VectorXd& zdot) {
    return body.truth.kinetic_energy(z, zdot);
  };
  RandomNumbers random(7);
  VectorXd V = 2 * random.vector(body.z.size());
  // Each section leaves different terms nonzero.
  SECTION("rotation only") { V.tail(3).setZero(); }
  SECTION("deformation only") { V.segment<3>(3).setZero(); }
  SECTION("all together") {}
  // Elastic and gravity terms, which have a test of their own, are removed.
  VectorXd elastic = VectorXd::Zero(V.size());
  body.constants.springs.add_loads(body.terms.a, Vector3d::Zero(), 1, elastic.tail(3));
  const VectorXd u = body.right_hand_side(V, Vector3d::Zero()) + elastic;
  const VectorXd expected = -lagrange(kinetic, body.z, V, VectorXd::Zero(V.size()));
  const double size = body.terms.mass.norm() * V.squaredNorm();
  CHECK((u.head<3>() - expected.head<3>()).norm() < kTolerance * size);
  CHECK((u.segment<3>(3) - expected.segment<3>(3)).norm() < kTolerance * size);
  CHECK((u.tail(3) - expected.tail(3)).norm() < kTolerance * size);
}

TEST_CASE("gravity and elastic forces follow from the points' potential energy") {
  Fixture body(3, GENERATE(false, true));
  const Vector3d gravity(1.5, -2.5, -9.81);
  const Lagrangian potential = [&](const VectorXd& z, const VectorXd&) {
    return -body.truth.potential_energy(z, gravity);
  };
  const VectorXd rest = VectorXd::Zero(body.z.size());
  CHECK(relative_error(body.right_hand_side(rest, gravity),
                       -lagrange(potential, body.z, rest, rest)) < kTolerance);
}

TEST_CASE("damping is 2 zeta omega of the modal rate and acts on the modes alone") {
  Fixture body(3);
  const Eigen::Vector3d zeta(0.1, 0.5, 0.9);
  const BodyConstants damped(DeformableBody{body.points.body, zeta});
  const VectorXd V = RandomNumbers(8).vector(9);
  const VectorXd without = body.right_hand_side(V, Vector3d::Zero());
  update_right_hand_side(damped, Vector3d::Zero(), V, body.terms);
  const VectorXd difference = body.terms.u - without;
  CHECK(difference.head<6>().norm() == 0);
  for (Index l = 0; l < 3; ++l) {
    const double omega = 2 * std::numbers::pi * body.points.body.frequencies_Hz[l];
    CHECK(difference[6 + l] == Approx(-2 * zeta[l] * omega * V[6 + l]).epsilon(1e-12));
  }
}

TEST_CASE("a rigid body about any origin moves as its points do") {
  const PointMassBody points = make_point_mass_body(12, 1);
  RigidBody rigid;
  rigid.mass_kg = points.masses_kg.sum();
  rigid.center_m = points.body.nodes_m * points.masses_kg / rigid.mass_kg;
  for (Index k = 0; k < points.point_count(); ++k) {
    const Vector3d r = points.body.nodes_m.col(k) - rigid.center_m;
    rigid.inertia_kg_m2 +=
        points.masses_kg[k] * (r.squaredNorm() * Matrix3d::Identity() - r * r.transpose());
  }
  const BodyConstants constants(rigid);
  BodyTerms terms(constants);
  RandomNumbers random(9);
  terms.A = random.rotation().toRotationMatrix();
  update_configuration(constants, terms);

  // The points have one mode that never moves.
  const Points truth(points, terms.A);
  const Vector3d gravity(0.3, 0.5, -9.81);
  const Lagrangian L = [&](const VectorXd& z, const VectorXd& zdot) {
    return truth.kinetic_energy(z, zdot) - truth.potential_energy(z, gravity);
  };
  VectorXd V = VectorXd::Zero(7);
  VectorXd Vdot = VectorXd::Zero(7);
  V.head<6>() = 3 * random.vector(6);
  Vdot.head<6>() = 3 * random.vector(6);
  update_right_hand_side(constants, gravity, V.head<6>(), terms);
  const VectorXd found = terms.mass * Vdot.head<6>() - terms.u;
  const VectorXd expected = lagrange(L, VectorXd::Zero(7), V, Vdot).head<6>();
  CHECK(relative_error(found, expected) < kTolerance);
}

TEST_CASE("energies of a moving body are those of its points") {
  Fixture body(4);
  const VectorXd V = 2 * RandomNumbers(10).vector(10);
  const Vector3d gravity(1, 2, -3);
  CHECK(kinetic_energy_J(body.terms, V) ==
        Approx(body.truth.kinetic_energy(body.z, V)).epsilon(1e-10));
  CHECK(gravitational_energy_J(body.constants, gravity, body.terms) +
            body.constants.springs.energy_J(body.terms.a) ==
        Approx(body.truth.potential_energy(body.z, gravity)).epsilon(1e-12));
}
