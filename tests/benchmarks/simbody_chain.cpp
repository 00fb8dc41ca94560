// SPDX-License-Identifier: GPL-3.0-or-later
// The rigid chain of chain_models.h in Simbody, for comparison.
#include "tests/benchmarks/simbody_chain.h"

#include <Simbody.h>
#include <cstdio>

#include "tests/benchmarks/timing.h"

namespace {

using SimTK::Inertia;
using SimTK::MassProperties;
using SimTK::Transform;
using SimTK::Vec3;

constexpr double kArm_m = 1.657;
constexpr double kNeck_m = 0.1438;
const Vec3 kHeadCenter(0.01, 0, -0.1);

SimTK::Body::Rigid body(double mass_kg, const Vec3& center, const Vec3& moments_kg_m2) {
  // Simbody expects the inertia about the body's origin.
  const Inertia about_origin = Inertia(moments_kg_m2).shiftFromMassCenter(-center, mass_kg);
  return SimTK::Body::Rigid(MassProperties(mass_kg, center, about_origin));
}

/// Chain ground - pin - arm - ball - neck - fixed - head, released at 60 degrees.
struct Chain {
  SimTK::MultibodySystem system;
  SimTK::SimbodyMatterSubsystem matter{system};
  SimTK::GeneralForceSubsystem forces{system};
  SimTK::Force::Gravity gravity{forces, matter, Vec3(0, 0.5, -9.81)};
  double moment = 29.57 * kArm_m * kArm_m / 12;
  // Simbody's pin rotates about z of its frames, which this brings to y.
  Transform about_y{SimTK::Rotation(-SimTK::Pi / 2, SimTK::XAxis)};
  SimTK::MobilizedBody::Pin arm{matter.Ground(), about_y,
                                body(29.57, Vec3(0, 0, -kArm_m / 2), Vec3(moment, moment, 0.1)),
                                about_y};
  SimTK::MobilizedBody::Ball neck{arm, Transform(Vec3(0, 0, -kArm_m)),
                                  body(1, Vec3(0, 0, -kNeck_m / 2), Vec3(2e-3, 2e-3, 1e-3)),
                                  Transform()};
  SimTK::MobilizedBody::Weld head{neck, Transform(Vec3(0, 0, -kNeck_m)),
                                  body(4.5, kHeadCenter, Vec3(0.016, 0.024, 0.022)), Transform()};
};

/// Position of the head's centre after 1 s.
Vec3 run(Chain& chain, const SimTK::State& start, double accuracy) {
  SimTK::RungeKuttaMersonIntegrator integrator(chain.system);
  integrator.setAccuracy(accuracy);
  integrator.setFinalTime(1);
  SimTK::TimeStepper stepper(chain.system, integrator);
  stepper.initialize(start);
  stepper.stepTo(1);
  return chain.head.findStationLocationInGround(integrator.getState(), kHeadCenter);
}

}  // namespace

namespace flexneck::benchmarks {

void report_simbody_chain(int runs) {
  Chain chain;
  SimTK::State start = chain.system.realizeTopology();
  chain.arm.setAngle(start, SimTK::Pi / 3);
  const Vec3 exact = run(chain, start, 1e-12);
  std::printf("rigid chain in Simbody, 1 s\n");
  std::printf("the head's centre ends at %.9f %.9f %.9f m\n", exact[0], exact[1], exact[2]);
  for (const double accuracy : {1e-4, 1e-5, 1e-6, 1e-7}) {
    Vec3 end;
    const Timing timing = measure(runs, [&] { end = run(chain, start, accuracy); });
    std::printf("%-18s %6.0e %9.3f ms %10.2e\n", "Simbody", accuracy, timing.median_ms,
                (end - exact).norm());
  }
}

}  // namespace flexneck::benchmarks
