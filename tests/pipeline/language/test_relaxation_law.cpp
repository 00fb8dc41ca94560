// SPDX-License-Identifier: GPL-3.0-or-later
#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>

#include <catch2/catch.hpp>
#include <fmt/ranges.h>

#include "geometry/foundation/temporary_folder.h"
#include "pipeline/experiments/relaxation_table.h"
#include "pipeline/language/model/model_file.h"
#include "pipeline/language/model/nonnegative_least_squares.h"
#include "pipeline/language/model/relaxation.h"
#include "tests/support/model_text.h"
#include "tests/support/point_mass_body.h"

using Catch::Matchers::Contains;
using Eigen::Index;
using Eigen::VectorXd;
using namespace flexneck;
using namespace flexneck::pipeline;

namespace {

constexpr double kPi = std::numbers::pi;

/// The branches of a section with a relaxation law.
Relaxation branches_of(const std::string& law) {
  const std::string text =
      "[solver]\nend_time = \"1 s\"\n[[body]]\nname = \"ground\"\nkind = \"ground\"\n" +
      testing::origin_marker_text("ground", "hook") + testing::box_text("box", "at") + R"(
[[section]]
name = "rubber"
lower = "ground.hook"
upper = "box.at"
length = ["0 m", "0 mm", "20 mm"]
translation_stiffness = ["1 N/m", "1 N/m", "1 N/m"]
rotation_stiffness = ["1 N*m/rad", "1 N*m/rad", "1 N*m/rad"]
relaxation_law = { )" +
      law + " }\n";
  const TemporaryFolder folder;
  const ModelFile file =
      read_model_file(testing::write_test_file(folder / "model.toml", text).string(), {});
  Relaxation found;
  for (const auto& branch : file.model.forces.of<multibody::Section>().front().branches) {
    found.times_s.push_back(branch.relaxation_time_s);
    found.shares.push_back(branch.stiffness(4, 4));
  }
  return found;
}

std::string list(const std::vector<double>& values, const char* unit) {
  std::vector<std::string> texts;
  texts.reserve(values.size());
  for (const double value : values) texts.push_back(fmt::format("\"{:.17g} {}\"", value, unit));
  return fmt::format("[{}]", fmt::join(texts, ", "));
}

}  // namespace

TEST_CASE("least squares that are not negative meet the conditions of their minimum") {
  testing::RandomNumbers random(7);
  int at_zero = 0;
  for (int trial = 0; trial < 200; ++trial) {
    Eigen::MatrixXd A(12, 6);
    random.fill(A);
    const VectorXd b = random.vector(12);
    const VectorXd x = nonnegative_least_squares(A, b);
    REQUIRE(x.minCoeff() >= 0);
    const VectorXd gradient = A.transpose() * (A * x - b);
    for (Index k = 0; k < x.size(); ++k) {
      if (x[k] == 0) {
        ++at_zero;
        REQUIRE(gradient[k] > -1e-11);
      } else {
        REQUIRE(std::abs(gradient[k]) < 1e-11);
      }
    }
  }
  CHECK(at_zero > 100);
}

TEST_CASE("a table made of Maxwell branches gives them back") {
  // Relaxation times of three branches between these ends.
  const std::vector<double> times_s = {1e-3, 1e-2, 1e-1};
  const Relaxation made{times_s, {0.2, 0.1, 0.4}, {}, {}};
  SECTION("dynamic modulus") {
    std::vector<double> frequencies_Hz, storage, loss;
    for (int k = 0; k <= 8; ++k) {
      frequencies_Hz.push_back(std::pow(10., k / 4.) / (2 * kPi * 0.1));
      const std::complex<double> modulus = 5e6 * modulus_ratio(made, frequencies_Hz.back());
      storage.push_back(modulus.real());
      loss.push_back(modulus.imag());
    }
    const Relaxation found = branches_of(
        "branches = 3, modulus = \"5 MPa\", frequencies = " + list(frequencies_Hz, "Hz") +
        ", storage = " + list(storage, "Pa") + ", loss = " + list(loss, "Pa"));
    REQUIRE(found.times_s.size() == 3);
    for (std::size_t k = 0; k < 3; ++k) {
      CHECK(found.times_s[k] == Approx(times_s[k]));
      CHECK(found.shares[k] == Approx(made.shares[k]).epsilon(1e-9));
    }
  }
  SECTION("relaxing modulus") {
    std::vector<double> at_s, moduli;
    for (int k = 0; k <= 8; ++k) {
      at_s.push_back(1e-3 * std::pow(10., k / 4.));
      moduli.push_back(5e6 * relaxed_ratio(made, at_s.back()));
    }
    const Relaxation found =
        branches_of("branches = 3, modulus = \"5 MPa\", times = " + list(at_s, "s") +
                    ", moduli = " + list(moduli, "Pa"));
    REQUIRE(found.times_s.size() == 3);
    for (std::size_t k = 0; k < 3; ++k)
      CHECK(found.shares[k] == Approx(made.shares[k]).epsilon(1e-8));
  }
}

TEST_CASE("a fractional law of order one is its branch") {
  const Relaxation found =
      branches_of("share = 0.6, time = \"30 ms\", order = 1, from = \"1 Hz\", to = \"20 Hz\"");
  REQUIRE(found.times_s.size() == 1);
  CHECK(found.times_s.front() == 0.03);
  CHECK(found.shares.front() == Approx(0.6).epsilon(1e-12));
}

TEST_CASE("branches of a fractional law follow its modulus, and its relaxation in time") {
  constexpr double kShare = 0.7;
  constexpr double kTime_s = 0.02;
  double last = 1;
  for (const int count : {3, 5, 9}) {
    const Relaxation found = branches_of(
        "share = 0.7, time = \"20 ms\", order = 0.5, from = \"0.1 Hz\", to = \"1000 Hz\", "
        "largest_error = 0.2, branches = " +
        std::to_string(count));
    double error = 0;
    for (int step = 0; step <= 136; ++step) {  // to 1000 Hz
      const double f = 0.1 * std::pow(1.07, step);
      const std::complex<double> law = fractional_ratio(kShare, kTime_s, 0.5, f);
      error = std::max(error, std::abs(modulus_ratio(found, f) - law) / std::abs(law));
    }
    // With many branches only the error at the band's ends remains, beyond which the spectrum
    // continues.
    CHECK(error < (count < 9 ? 0.5 : 1) * last);
    last = error;
    if (count < 9) continue;
    CHECK(error < 0.015);
    // With order 1/2 the law relaxes as 1 - share (1 - exp(x) erfc(sqrt x)), x = t / tau
    // (Mittag-Leffler's function of order 1/2).
    for (const double t : {0.001, 0.002, 0.004, 0.008, 0.016, 0.032, 0.064, 0.128, 0.256}) {
      const double x = t / kTime_s;
      const double law = 1 - kShare * (1 - std::exp(x) * boost::math::erfc(std::sqrt(x)));
      CHECK(relaxed_ratio(found, t) == Approx(law).epsilon(0.01));
    }
  }
}

TEST_CASE("laws of relaxation that make no sense, or that branches do not follow, are refused") {
  const auto refused = [](const std::string& law, const char* message) {
    CHECK_THROWS_WITH(branches_of(law), Contains(message));
  };
  const std::string fractional =
      "share = 0.7, time = \"20 ms\", order = 0.5, from = \"0.1 Hz\", to = \"1000 Hz\"";
  refused(fractional + ", branches = 2",
          "relaxation_law.branches: 2 branches fitted to a fractional law");
  refused(fractional + ", times = [\"1 s\", \"2 s\"]",
          "relaxation_law.times: expected a single law");
  refused("share = 0.7", "expected a relaxation law");
  refused("share = 1.2, time = \"1 s\", order = 0.5, from = \"1 Hz\", to = \"2 Hz\"",
          "relaxation_law.share");
  const std::string table = "modulus = \"5 MPa\", frequencies = [\"1 Hz\", \"10 Hz\"], ";
  refused(table + "storage = [\"3 MPa\", \"6 MPa\"], loss = [\"0 MPa\", \"0 MPa\"]",
          "the shares do not exceed one");
  refused(
      "modulus = \"5 MPa\", frequencies = [\"10 Hz\", \"1 Hz\"], storage = [\"3 MPa\", \"4 MPa\"]"
      ", loss = [\"0 MPa\", \"0 MPa\"]",
      "increase strictly, which is not the case for value 2");
  // A storage modulus that falls with frequency is not a spectrum of relaxation.
  refused(table + "storage = [\"4 MPa\", \"2 MPa\"], loss = [\"1 MPa\", \"1 MPa\"]",
          "fitted to a table of the dynamic modulus");
}
