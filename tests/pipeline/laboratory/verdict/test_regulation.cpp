// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <fstream>

#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "geometry/foundation/input_file.h"
#include "geometry/foundation/temporary_folder.h"
#include "geometry/foundation/units.h"
#include "pipeline/language/study/regulation.h"

using Catch::Matchers::Contains;
using namespace flexneck;
using namespace flexneck::pipeline;
using multibody::ChannelClass;

namespace {

namespace fs = std::filesystem;

const fs::path kFolder = fs::path(FLEXNECK_SOURCE_DIR) / "pipeline/data/regulations";

void check(const Limits& limits, double low, double high, const std::string& si,
           const std::string& unit) {
  CHECK(limits.low * factor_from_si(si, unit) == Approx(low));
  CHECK(limits.high * factor_from_si(si, unit) == Approx(high));
}
void check_ms(const std::optional<Limits>& limits, double low, double high) {
  REQUIRE(limits);
  check(*limits, low, high, "s", "ms");
}

/// The text of 572.33 with one change.
std::string changed(const std::string& was, const std::string& is) {
  std::string text = text_of_file(kFolder / "572.33.toml");
  const std::size_t place = text.find(was);
  REQUIRE(place != std::string::npos);
  return text.replace(place, was.size(), is);
}

std::string refusal(const std::string& text) {
  const TemporaryFolder folder;
  std::ofstream(folder / "bad.toml") << text;
  std::string message;
  try {
    read_regulation(folder / "bad.toml");
  } catch (const InputError& error) {
    message = error.what();
  }
  CHECK_THAT(message, Contains("bad.toml:"));
  CHECK(message.find('\n') == std::string::npos);
  return message;
}

}  // namespace

TEST_CASE("the file of 572.33 says what its text says") {
  const CertificationTest flexion = shipped_test("572.33 flexion").test;
  CHECK(flexion.dummy == "Hybrid III 50th male");
  CHECK_THAT(flexion.source, Contains("49 CFR 572.33"));
  CHECK(flexion.moment_definition.arm_m == Approx(0.058 * 0.3048));
  CHECK(flexion.moment_definition.force_filter == ChannelClass::cfc600);
  CHECK(flexion.moment_definition.moment_filter == ChannelClass::cfc600);
  CHECK(flexion.pendulum_filter == ChannelClass::cfc60);
  CHECK_FALSE(flexion.is_zeroed);
  CHECK_FALSE(flexion.moment.while_rotation_inside);
  check(flexion.impact_velocity_m_s, 22.6, 23.4, "m/s", "ft/s");
  check(flexion.rotation.peak_rad, 64, 78, "rad", "deg");
  check_ms(flexion.rotation.time_of_peak_s, 57, 64);
  check_ms(flexion.rotation.first_zero_crossing_s, 113, 128);
  check(flexion.moment.peak_Nm, 65, 80, "N*m", "lbf*ft");
  check_ms(flexion.moment.time_of_peak_s, 47, 58);
  CHECK(flexion.moment.decay_to_Nm == 0);
  check_ms(flexion.moment.time_of_decay_s, 97, 107);

  const CertificationTest extension = shipped_test("572.33 extension").test;
  CHECK(extension.direction == CertificationTest::Direction::extension);
  check(extension.impact_velocity_m_s, 19.5, 20.3, "m/s", "ft/s");
  check(extension.rotation.peak_rad, 81, 106, "rad", "deg");
  check_ms(extension.rotation.time_of_peak_s, 72, 82);
  check_ms(extension.rotation.first_zero_crossing_s, 147, 174);
  check(extension.moment.peak_Nm, -59, -39, "N*m", "lbf*ft");
  check_ms(extension.moment.time_of_peak_s, 65, 79);
  CHECK(extension.moment.decay_to_Nm == 0);
  check_ms(extension.moment.time_of_decay_s, 120, 148);
}

TEST_CASE("the pulses of 572.33 are those of its tables A and B") {
  const auto check_pulse = [](const char* name, const std::array<double, 6>& corridor,
                              double highest, double from_ms, double to_ms) {
    const CertificationTest test = shipped_test(name).test;
    const auto& pulse = std::get<DecelerationPulse>(test.pulse);
    CHECK(pulse.times_s == std::vector{0.010, 0.020, 0.030});
    REQUIRE(pulse.deceleration_m_s2.size() == 3);
    for (std::size_t k = 0; k < 3; ++k)
      check(pulse.deceleration_m_s2[k], corridor.at(2 * k), corridor.at(2 * k + 1), "m/s^2", "gn");
    CHECK(pulse.highest_after_m_s2 == Approx(highest * kStandardGravity_m_s2));
    CHECK(pulse.decay_to_m_s2 == Approx(5 * kStandardGravity_m_s2));
    check_ms(pulse.time_of_decay_s, from_ms, to_ms);
  };
  check_pulse("572.33 flexion", {22.5, 27.5, 17.6, 22.6, 12.5, 18.5}, 29, 34, 42);
  check_pulse("572.33 extension", {17.2, 21.2, 14, 19, 11, 16}, 22, 38, 46);
}

namespace {

struct VelocityCase {
  const char* name;
  const char* dummy;
  double velocity_m_s;
  Limits rotation_deg, moment_Nm;
  double decay_to_Nm;
  Limits decay_ms;
  std::array<double, 6> lost_m_s;
};

}  // namespace

TEST_CASE("the files of 572.133 and 572.123 say what their texts say") {
  const char* const female = "Hybrid III 5th female";
  const char* const child = "Hybrid III six-year-old";
  for (const VelocityCase& each : {
           VelocityCase{"572.133 flexion",
                        female,
                        7.01,
                        {77, 91},
                        {69, 83},
                        10,
                        {80, 100},
                        {2.1, 2.5, 4.0, 5.0, 5.8, 7.0}},
           VelocityCase{"572.133 extension",
                        female,
                        6.07,
                        {99, 114},
                        {-65, -53},
                        -10,
                        {94, 114},
                        {1.5, 1.9, 3.1, 3.9, 4.6, 5.6}},
           VelocityCase{"572.123 flexion",
                        child,
                        4.95,
                        {74, 92},
                        {27, 33},
                        5,
                        {103, 123},
                        {1.2, 1.6, 2.4, 3.4, 3.8, 5.0}},
           VelocityCase{"572.123 extension",
                        child,
                        4.3,
                        {85, 103},
                        {-24, -19},
                        -5,
                        {123, 147},
                        {1.0, 1.4, 2.2, 3.0, 3.2, 4.2}},
       }) {
    INFO(each.name);
    const CertificationTest test = shipped_test(each.name).test;
    CHECK(test.dummy == each.dummy);
    CHECK(test.is_zeroed);
    CHECK(test.moment_definition.arm_m == 0.01778);
    CHECK(test.moment_definition.force_filter == ChannelClass::cfc1000);
    CHECK(test.moment_definition.moment_filter == ChannelClass::cfc600);
    CHECK(test.pendulum_filter == ChannelClass::cfc180);
    check(test.impact_velocity_m_s, each.velocity_m_s - 0.12, each.velocity_m_s + 0.12, "m/s",
          "m/s");
    check(test.rotation.peak_rad, each.rotation_deg.low, each.rotation_deg.high, "rad", "deg");
    CHECK_FALSE(test.rotation.time_of_peak_s);
    CHECK_FALSE(test.rotation.first_zero_crossing_s);
    CHECK(test.moment.while_rotation_inside);
    check(test.moment.peak_Nm, each.moment_Nm.low, each.moment_Nm.high, "N*m", "N*m");
    CHECK_FALSE(test.moment.time_of_peak_s);
    CHECK(test.moment.decay_to_Nm == each.decay_to_Nm);
    check_ms(test.moment.time_of_decay_s, each.decay_ms.low, each.decay_ms.high);
    const auto& pulse = std::get<VelocityPulse>(test.pulse);
    CHECK(pulse.times_s == std::vector{0.010, 0.020, 0.030});
    for (std::size_t k = 0; k < 3; ++k)
      check(pulse.lost_m_s.at(k), each.lost_m_s.at(2 * k), each.lost_m_s.at(2 * k + 1), "m/s",
            "m/s");
  }
}

TEST_CASE("a regulation that cannot be is refused in one line") {
  CHECK_THAT(
      refusal(changed("time_of_peak = [\"57", "time_of_peek = [\"57")),
      Contains("test.flexion.rotation.time_of_peek: unknown key") && Contains("'time_of_peak'"));
  CHECK_THAT(refusal(changed("[\"64 deg\", \"78 deg\"]", "[\"78 deg\", \"64 deg\"]")),
             Contains("test.flexion.rotation.peak: expected a lower limit"));
  CHECK_THAT(refusal(changed("[\"64 deg\", \"78 deg\"]", "[\"64 deg\"]")),
             Contains("test.flexion.rotation.peak"));
  CHECK_THAT(refusal(changed("[\"64 deg\"", "[\"64 ms\"")), Contains("test.flexion.rotation.peak"));
  CHECK_THAT(refusal(changed("low = [\"22.50 gn\"", "low = [\"28 gn\"")),
             Contains("test.flexion.pulse.high: expected values above those of 'low'"));
  CHECK_THAT(refusal(changed("low = [\"22.50 gn\", ", "low = [")),
             Contains("test.flexion.pulse.low"));
  CHECK_THAT(refusal(changed("times = [\"10 ms\", \"20 ms\"", "times = [\"20 ms\", \"10 ms\"")),
             Contains("test.flexion.pulse.times: expected at least one time"));
  CHECK_THAT(refusal(changed("[\"-59 lbf*ft\", \"-39 lbf*ft\"]", "[\"39 lbf*ft\", \"59 lbf*ft\"]")),
             Contains("test.extension.moment.peak: expected negative moments"));
  CHECK_THAT(refusal(changed("[\"65 lbf*ft\"", "[\"-65 lbf*ft\"")),
             Contains("test.flexion.moment.peak: expected positive moments"));
  CHECK_THAT(refusal(changed("decay_to = \"0 lbf*ft\"", "decay_to = \"66 lbf*ft\"")),
             Contains("test.flexion.moment.decay_to: expected a moment between zero and the peak"));
  CHECK_THAT(refusal(changed("kind = \"deceleration\"", "kind = \"velocity lost\"")),
             Contains("test.flexion.pulse.low"));
  CHECK_THAT(refusal(changed("kind = \"deceleration\"", "kind = \"velocity\"")),
             Contains("test.flexion.pulse.kind"));
  CHECK_THAT(refusal(changed("pendulum_filter = \"CFC 60\"", "pendulum_filter = \"CFC 61\"")),
             Contains("pendulum_filter"));
  CHECK_THAT(refusal(changed("source = ", "sources = ")), Contains("source: expected this key"));
  CHECK_THAT(refusal(changed("name = \"extension\"", "name = \"flexion\"")),
             Contains("test: test '572.33 flexion' occurs twice"));
}

TEST_CASE("a test that no regulation has is refused with the names there are") {
  CHECK_THROWS_WITH(shipped_test("572.33 flexoin"),
                    Contains("did you mean '572.33 flexion'") && Contains("572.133 extension"));
}
