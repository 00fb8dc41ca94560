// SPDX-License-Identifier: GPL-3.0-or-later
// Target: certification tests of a regulation.
#include <algorithm>
#include <cmath>
#include <set>

#include "pipeline/language/study/regulation.h"
#include "tests/reliability/fuzz/input_folder.h"

using namespace flexneck;

namespace {

void check(const pipeline::Limits& limits) {
  fuzz::require(!std::isnan(limits.low) && limits.low < limits.high, "limits are in order");
}

void check(const std::vector<double>& times_s, std::size_t values) {
  fuzz::require(times_s.size() == values, "there are limits at each time");
  fuzz::require(
      std::adjacent_find(times_s.begin(), times_s.end(), std::greater_equal<>()) == times_s.end(),
      "times increase strictly");
}

void check(const pipeline::CertificationTest& test) {
  check(test.impact_velocity_m_s);
  check(test.rotation.peak_rad);
  check(test.moment.peak_Nm);
  check(test.moment.time_of_decay_s);
  fuzz::require(std::isfinite(test.moment.decay_to_Nm), "a level is finite");
  fuzz::require(test.moment_definition.arm_m >= 0, "an arm is a length");
  if (const auto* const pulse = std::get_if<pipeline::DecelerationPulse>(&test.pulse))
    check(pulse->times_s, pulse->deceleration_m_s2.size());
  if (const auto* const pulse = std::get_if<pipeline::VelocityPulse>(&test.pulse))
    check(pulse->times_s, pulse->lost_m_s.size());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::InputFolder folder;
  const std::string text = fuzz::text_of(data, size);
  return fuzz::try_reader([&] {
    std::set<std::string> names;
    for (const pipeline::CertificationTest& test :
         pipeline::read_regulation(folder.with("regulation.toml", text))) {
      check(test);
      fuzz::require(names.insert(test.name).second, "names are given once");
    }
  });
}
