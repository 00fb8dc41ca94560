// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <complex>
#include <fstream>
#include <numbers>

#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "geometry/foundation/temporary_folder.h"
#include "pipeline/experiments/pendulum.h"
#include "pipeline/experiments/pulse_tables.h"
#include "pipeline/language/model/pulse.h"
#include "tests/support/beam_experiment.h"

using Catch::Matchers::Contains;
using namespace flexneck;
using namespace flexneck::pipeline;

namespace {

const std::vector<double> kTimes = {0.002, 0.01, 0.03, 0.04};
const std::vector<double> kValues = {10, 200, 150, 0};

/// Trapezoidal rule, exact for functions that are linear between rows.
double area(const std::vector<double>& x, const std::vector<double>& y) {
  double sum = 0;
  for (std::size_t k = 1; k < x.size(); ++k) sum += (x[k] - x[k - 1]) * (y[k] + y[k - 1]) / 2;
  return sum;
}

constexpr double kRounding = 1e-12;

}  // namespace

TEST_CASE("a pulse is brought to a velocity by its amplitude or by its duration") {
  const double velocity = 3;
  const FittedPulse high = fitted_pulse(kTimes, kValues, velocity, PulseFit::amplitude);
  CHECK(high.area_m_s == Approx(area(kTimes, kValues)).epsilon(kRounding));
  CHECK(high.times_s == kTimes);
  CHECK(area(high.times_s, high.deceleration_m_s2) == Approx(velocity).epsilon(kRounding));
  const FittedPulse longer = fitted_pulse(kTimes, kValues, velocity, PulseFit::duration);
  CHECK(longer.deceleration_m_s2 == kValues);
  CHECK(longer.times_s.front() == kTimes.front());
  CHECK(area(longer.times_s, longer.deceleration_m_s2) == Approx(velocity).epsilon(kRounding));
  const FittedPulse same = fitted_pulse(kTimes, kValues, velocity, PulseFit::none);
  CHECK(same.deceleration_m_s2 == kValues);
  CHECK(same.velocity_left_m_s == Approx(velocity - area(kTimes, kValues)).epsilon(kRounding));
  CHECK_THROWS_WITH(fitted_pulse({0, 1}, {-1, 0}, velocity, PulseFit::duration),
                    Contains("expected a decelerating pulse"));
}

TEST_CASE("the spectrum of a pulse is its Fourier integral") {
  for (const double frequency_Hz : {0.0, 1e-3, 5.0, 36.1, 250.0}) {
    INFO(frequency_Hz);
    // Midpoint rule, of order 2: the error falls with the square of the interval.
    constexpr int kSteps = 40000;
    std::complex<double> sum = 0;
    for (std::size_t k = 1; k < kTimes.size(); ++k) {
      const double h = (kTimes[k] - kTimes[k - 1]) / kSteps;
      for (int i = 0; i < kSteps; ++i) {
        const double u = (i + 0.5) / kSteps;
        const double t = kTimes[k - 1] + u * (kTimes[k] - kTimes[k - 1]);
        sum += h * (kValues[k - 1] + u * (kValues[k] - kValues[k - 1])) *
               std::polar(1.0, -2 * std::numbers::pi * frequency_Hz * t);
      }
    }
    CHECK(std::abs(fourier_transform(kTimes, kValues, frequency_Hz) - sum) < 1e-7);
  }
}

TEST_CASE("a user's pulse comes from a CSV file with its units") {
  const TemporaryFolder folder;
  std::ofstream(folder / "mine.csv") << "time [ms], deceleration [gn]\n0, 0\n10, 20\n50, 0\n";
  std::ofstream(folder / "study.toml") << "include = [\"" << built_in_study().string() << "\"]\n"
                                       << "[[pulse]]\nname = \"flexion\"\ntable = \"mine.csv\"\n";
  CHECK_THROWS_WITH(read_study(folder / "study.toml", {}),
                    Contains("pulse.flexion.times: is given both") && Contains("times = []"));
  std::ofstream(folder / "study.toml", std::ios::app) << "times = []\ndeceleration = []\n";
  const Study study = read_study(folder / "study.toml", {"pendulum.pulse_scaling=none"});
  CHECK(study.pulses.at(0).times_s.at(1) == Approx(0.01));
  CHECK(study.pulses.at(0).deceleration_m_s2.at(1) == Approx(20 * 9.80665));
  CHECK(study.tables.at(0).name == "mine.csv");
  const testing::BeamExperiment built_in;
  const FittedPulse pulse = case_pulse(study, built_in.named("flexion-120"));
  CHECK(pulse.area_m_s == Approx(0.5 * 0.05 * 20 * 9.80665));
}

TEST_CASE("what is done to a pulse is told in a line, where anything is") {
  const auto entry_with = [](double velocity_m_s, PulseFit fit) {
    PendulumEntry entry;
    entry.experiment.pulse = "mine";
    entry.pulse = fitted_pulse(kTimes, kValues, velocity_m_s, fit);
    return entry;
  };
  const double own_m_s = area(kTimes, kValues);
  CHECK(scaling_lines({entry_with(own_m_s, PulseFit::amplitude)}).empty());
  CHECK(scaling_lines({entry_with(own_m_s / 2, PulseFit::none)}).empty());
  CHECK(scaling_lines({entry_with(own_m_s / 2, PulseFit::amplitude),
                       entry_with(own_m_s / 4, PulseFit::amplitude)}) ==
        std::vector<std::string>{"Pulse 'mine', scaled to stop the arm: amplitude times 0.25 to "
                                 "0.5, largest 5.1 to 10.2 gn"});
  CHECK(scaling_lines({entry_with(2 * own_m_s, PulseFit::duration)}) ==
        std::vector<std::string>{"Pulse 'mine', scaled to stop the arm: duration times 2, largest "
                                 "20.4 gn"});
}
