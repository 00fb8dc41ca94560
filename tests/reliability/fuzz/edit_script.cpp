// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/reliability/fuzz/edit_script.h"

#include <bit>
#include <limits>

namespace flexneck::fuzz {

namespace {

using Real = std::numeric_limits<double>;
constexpr std::array kReals = {0.0,
                               -0.0,
                               1.0,
                               -1.0,
                               0.5,
                               1e-300,
                               1e300,
                               -1e300,
                               Real::quiet_NaN(),
                               Real::infinity(),
                               -Real::infinity(),
                               Real::denorm_min(),
                               Real::max(),
                               1e10,
                               -1e-10};
constexpr std::array<std::int64_t, 16> kIntegers = {0,
                                                    1,
                                                    -1,
                                                    2,
                                                    3,
                                                    7,
                                                    8,
                                                    100,
                                                    INT32_MAX,
                                                    INT32_MIN,
                                                    INT64_MAX,
                                                    INT64_MIN,
                                                    std::int64_t{1} << 31,
                                                    std::int64_t{1} << 32,
                                                    1000000,
                                                    -7};

}  // namespace

std::uint8_t EditScript::byte() {
  if (rest_.empty()) return 0;
  const std::uint8_t first = rest_.front();
  rest_ = rest_.subspan(1);
  return first;
}

std::uint64_t EditScript::number(std::size_t bytes) {
  std::uint64_t value = 0;
  for (std::size_t k = 0; k < bytes; ++k) value |= std::uint64_t{byte()} << 8 * k;
  return value;
}

double EditScript::real() {
  const std::size_t choice = byte();
  return choice < kReals.size() ? kReals[choice] : std::bit_cast<double>(number(8));
}

std::int64_t EditScript::integer() {
  const std::size_t choice = byte();
  if (choice < kIntegers.size()) return kIntegers[choice];
  return choice < 128 ? byte() : static_cast<std::int64_t>(number(8));
}

std::string EditScript::text(const std::vector<std::string>& known) {
  const std::size_t choice = byte();
  if (choice < 192 && !known.empty()) return among(known);
  std::string text;
  for (std::size_t left = choice % 32; left > 0; --left) text += static_cast<char>(byte());
  return text;
}

}  // namespace flexneck::fuzz
