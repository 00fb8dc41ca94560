// SPDX-License-Identifier: GPL-3.0-or-later
#include <stdexcept>

#include <catch2/catch.hpp>

#include "geometry/foundation/units.h"
#include "pipeline/laboratory/verdict/pulse_rules.h"
#include "pipeline/language/study/regulation.h"

using namespace flexneck;
using namespace flexneck::pipeline;

namespace {

CertificationTest test_of(const char* name) { return shipped_test(name).test; }

PulseCurve pulse(const std::vector<double>& times_ms, const std::vector<double>& gn) {
  PulseCurve curve;
  const auto size = static_cast<Eigen::Index>(times_ms.size());
  curve.time_s = Eigen::Map<const Eigen::VectorXd>(times_ms.data(), size) * 1e-3;
  curve.deceleration_m_s2 =
      Eigen::Map<const Eigen::VectorXd>(gn.data(), size) * kStandardGravity_m_s2;
  return curve;
}

const JudgedFigure& figure(const std::vector<JudgedFigure>& figures, const std::string& name) {
  for (const JudgedFigure& each : figures)
    if (each.name == name) return each;
  throw std::runtime_error("no figure " + name);
}

double value_gn(const std::vector<JudgedFigure>& figures, const std::string& name) {
  return *figure(figures, name).value / kStandardGravity_m_s2;
}

}  // namespace

TEST_CASE("a pulse by its deceleration: at times, after them, and as it decays") {
  const CertificationTest test = test_of("572.33 flexion");
  const auto figures = judged_conditions(
      test, 7.01, pulse({0, 5, 15, 25, 32, 36, 41, 60}, {0, 26, 22, 18, 14, 15, 0, 0}));
  REQUIRE(figures.size() == 6);
  CHECK(*figure(figures, "impact velocity").value == 7.01);
  CHECK(value_gn(figures, "pulse at 10 ms") == Approx(24));
  CHECK(value_gn(figures, "pulse at 20 ms") == Approx(20));
  CHECK(value_gn(figures, "pulse at 30 ms") == Approx(18 - 4 * 5.0 / 7));
  CHECK(value_gn(figures, "pulse after 30 ms") == Approx(15));
  // The pulse falls from 15 gn at 36 ms to zero at 41 ms.
  CHECK(*figure(figures, "time of pulse decay").value == Approx(36e-3 + 5e-3 * 10 / 15));
  for (const JudgedFigure& each : figures) CHECK(each.is_inside());
}

TEST_CASE("a pulse outside says where and how much") {
  const CertificationTest test = test_of("572.33 flexion");
  const auto figures =
      judged_conditions(test, 7.2, pulse({0, 10, 20, 30, 40, 50}, {0, 28.1, 17, 14, 30, 1}));
  const auto text = [&](const char* name) { return outside_text(figure(figures, name), test); };
  CHECK(text("impact velocity") ==
        "impact velocity: 23.62 ft/s, 0.22 ft/s above 22.60 to 23.40 ft/s");
  CHECK(text("pulse at 10 ms") == "pulse at 10 ms: 28.10 gn, 0.60 gn above 22.50 to 27.50 gn");
  CHECK(text("pulse at 20 ms") == "pulse at 20 ms: 17.00 gn, 0.60 gn below 17.60 to 22.60 gn");
  CHECK(figure(figures, "pulse at 30 ms").is_inside());
  CHECK(text("pulse after 30 ms") == "pulse after 30 ms: 30.00 gn, 1.00 gn above at most 29.00 gn");
  CHECK(text("time of pulse decay") ==
        "time of pulse decay: 48.6 ms, 6.6 ms above 34.0 to 42.0 ms");

  const auto short_one = judged_conditions(test, 7, pulse({0, 15, 25}, {20, 20, 20}));
  CHECK(outside_text(figure(short_one, "pulse at 30 ms"), test) ==
        "pulse at 30 ms: the curve does not reach that time");
  CHECK(outside_text(figure(short_one, "time of pulse decay"), test) ==
        "time of pulse decay: not within the curve");
}

TEST_CASE("a pulse by the velocity lost: areas of trapezoids") {
  const CertificationTest test = test_of("572.133 flexion");
  PulseCurve constant;  // 230 m/s^2, at times of its own, with a beginning before the contact
  constant.time_s = Eigen::VectorXd::LinSpaced(25, -0.0031, 0.0419);
  constant.deceleration_m_s2 = Eigen::VectorXd::Constant(25, 230);
  const auto figures = judged_conditions(test, 7.01, constant);
  REQUIRE(figures.size() == 4);
  CHECK(*figure(figures, "velocity lost at 10 ms").value == Approx(2.3));
  CHECK(*figure(figures, "velocity lost at 20 ms").value == Approx(4.6));
  CHECK(*figure(figures, "velocity lost at 30 ms").value == Approx(6.9));
  CHECK(*figure(figures, "velocity lost at 30 ms").half_corridors() == Approx(0.5 / 0.6));
  for (const JudgedFigure& each : figures) CHECK(each.is_inside());

  // A ramp a t has the velocity a t^2 / 2.
  PulseCurve ramp;
  ramp.time_s = Eigen::VectorXd::LinSpaced(8, 0, 0.035);
  ramp.deceleration_m_s2 = 8000 * ramp.time_s;
  const auto slow = judged_conditions(test_of("572.123 extension"), 4.5, ramp);
  CHECK(*figure(slow, "velocity lost at 10 ms").value == Approx(0.4));
  CHECK(*figure(slow, "velocity lost at 20 ms").value == Approx(1.6));
  CHECK(*figure(slow, "velocity lost at 30 ms").value == Approx(3.6));
  CHECK(outside_text(figure(slow, "velocity lost at 10 ms"), test_of("572.123 extension")) ==
        "velocity lost at 10 ms: 0.40 m/s, 0.60 m/s below 1.00 to 1.40 m/s");
  CHECK(figure(slow, "velocity lost at 30 ms").is_inside());
  CHECK_FALSE(figure(slow, "impact velocity").is_inside());
}

TEST_CASE("a pulse that cannot be judged is refused") {
  PulseCurve bad = pulse({0, 10}, {1, 2});
  bad.time_s.resize(1);
  CHECK_THROWS_AS(judged_conditions(test_of("572.33 flexion"), 7, bad), std::invalid_argument);
}
