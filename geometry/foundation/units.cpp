// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/foundation/units.h"

#include <array>
#include <charconv>
#include <clocale>
#include <cmath>
#include <memory>
#include <mutex>
#include <new>
#include <regex>
#include <string>
#include <unordered_map>

#include <udunits2.h>

#include "geometry/foundation/error.h"
#include "geometry/foundation/printable.h"

namespace flexneck {

namespace {

using UnitSystem = std::unique_ptr<ut_system, decltype(&ut_free_system)>;
using Unit = std::unique_ptr<ut_unit, decltype(&ut_free)>;
using Converter = std::unique_ptr<cv_converter, decltype(&cv_free)>;

/// Reading the unit database takes milliseconds, so it is read once; it never changes afterwards.
const ut_system& unit_system() {
  static const UnitSystem system = [] {
    ut_set_error_message_handler(ut_ignore);
    UnitSystem fresh(ut_read_xml(UDUNITS2_DATABASE), ut_free_system);
    if (!fresh)
      throw ComputationError(std::string("the unit database of UDUNITS-2 cannot be read: ") +
                             UDUNITS2_DATABASE);
    // The database has these units under longer names only.
    const Unit gravity(ut_parse(fresh.get(), "standard_free_fall", UT_ASCII), ut_free);
    const Unit degree(ut_parse(fresh.get(), "arc_degree", UT_ASCII), ut_free);
    if (ut_map_symbol_to_unit("gn", UT_ASCII, gravity.get()) != UT_SUCCESS ||
        ut_map_symbol_to_unit("deg", UT_ASCII, degree.get()) != UT_SUCCESS) {
      throw ComputationError("the unit database of UDUNITS-2 lacks gravity or degree");
    }
    return fresh;
  }();
  return *system;
}

/// True for names with whole exponents, joined by '*', '.', '/' or a space. UDUNITS-2 accepts
/// multiples besides ("kg 2", "kg^2.5" and "m/2" are 2 kg, 5 kg^2 and 0.5 m), origins and
/// logarithms: all of them would silently change the number that stands before the unit.
bool is_plain_unit(const std::string& text) {
  constexpr std::size_t kMaxCharacters = 80;  // std::regex uses stack for each
  static const std::regex kPattern = [] {
    const std::string power = "((\\^|\\*\\*)?[+-]?[0-9]+)?";
    const std::string factor = "(\\( *)*((\u00b5)?[A-Za-z_]+|%)" + power + "( *\\)" + power + ")*";
    return std::regex("1|(1 */ *)?" + factor + "(( *[*./] *| +)" + factor + ")*");
  }();
  return text.size() <= kMaxCharacters && std::regex_match(text, kPattern);
}

Unit parse_unit(std::string_view text) {
  const std::string name(text);
  if (!is_plain_unit(name)) {
    throw InputError("expected a unit such as 'kg*m^2' or 'm/s', found '" + printable(name) +
                     "'; decimals have a point, and a unit contains no number");
  }
  Unit unit(ut_parse(&unit_system(), name.c_str(), UT_ASCII), ut_free);
  if (!unit && ut_get_status() == UT_OS) throw std::bad_alloc();
  if (!unit) throw InputError("unknown unit '" + name + "'");
  return unit;
}

/// Exponent of the radian: UDUNITS-2 converts as if it were 1, so that 1 Hz would be 1 rad/s.
int radians(const ut_unit& unit) {
  std::array<char, 256> definition{};
  const int length =
      ut_format(&unit, definition.data(), definition.size(), UT_ASCII | UT_DEFINITION);
  if (length < 0 || length >= static_cast<int>(definition.size())) return 0;
  std::cmatch found;
  static const std::regex kPattern("(^|[ .])rad(-?[0-9]*)([ .]|$)");
  if (!std::regex_search(definition.data(), found, kPattern)) return 0;
  const std::string exponent = found[2];
  return exponent.empty() ? 1 : std::stoi(exponent);
}

/// True for "g" beside an acceleration: there it cannot be the gram, and test reports mean gravity.
bool is_gravity(std::string_view unit, std::string_view beside) {
  if (unit != "g") return false;
  const Unit acceleration = parse_unit("gn");
  return ut_are_convertible(parse_unit(beside).get(), acceleration.get()) != 0;
}

/// Sets the locale of C for this thread during its lifetime: UDUNITS-2 reads and writes numbers in
/// the locale of the process, whose decimal sign may be a comma.
class PlainLocale {
 public:
  PlainLocale() : locale_(::newlocale(LC_ALL_MASK, "C", nullptr)) {
    if (locale_ == nullptr) throw std::bad_alloc();
    before_ = ::uselocale(locale_);
  }
  ~PlainLocale() {
    ::uselocale(before_);
    ::freelocale(locale_);
  }
  PlainLocale(const PlainLocale&) = delete;
  PlainLocale& operator=(const PlainLocale&) = delete;

 private:
  locale_t locale_, before_ = nullptr;
};

/// Factor between two units. Units with an offset (such as degrees Celsius) are refused.
double computed_factor(std::string_view from, std::string_view to) {
  const PlainLocale plain;
  const Unit source = parse_unit(is_gravity(from, to) ? "gn" : from);
  const Unit target = parse_unit(is_gravity(to, from) ? "gn" : to);
  const Converter converter(ut_get_converter(source.get(), target.get()), cv_free);
  const int angle = radians(*source);
  const bool is_pure_number = ut_is_dimensionless(source.get()) != 0 && angle == 0;
  if (!converter || angle != radians(*target) || (is_pure_number && to != from) ||
      cv_convert_double(converter.get(), 0.0) != 0) {
    throw InputError("expected a unit such as '" + std::string(to) + "', found '" +
                     std::string(from) + "', which has another dimension");
  }
  return cv_convert_double(converter.get(), 1.0);
}

/// Cache of factors: a unit takes far longer to parse than a number, and a file has few of them.
/// UDUNITS-2 keeps internal state, so one thread at a time may use it.
class FactorTable {
 public:
  double factor(std::string_view from, std::string_view to) {
    const std::string pair = std::string(from) + '\n' + std::string(to);
    const std::scoped_lock lock(mutex_);
    const auto known = factors_.find(pair);
    if (known != factors_.end()) return known->second;
    const double found = computed_factor(from, to);
    constexpr std::size_t kMax = 1000;  // bounds the cache for files with ever new units
    if (factors_.size() < kMax) factors_.emplace(pair, found);
    return found;
  }

 private:
  std::mutex mutex_;
  std::unordered_map<std::string, double> factors_;
};

double factor(std::string_view from, std::string_view to) {
  static FactorTable table;
  return table.factor(from, to);
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

}  // namespace

double parse_quantity(std::string_view text, std::string_view si_unit) {
  const std::string_view body = trimmed(text);
  double value = 0;
  const auto [end, error] = std::from_chars(body.data(), body.data() + body.size(), value);
  const std::string example = "\"1.5 " + std::string(si_unit) + "\"";
  const std::string found = ", found \"" + printable(text) + "\"";
  if (error != std::errc() || !std::isfinite(value)) {
    throw InputError("expected a number with its unit such as " + example + found);
  }
  const std::string_view unit = trimmed(body.substr(static_cast<std::size_t>(end - body.data())));
  if (unit.empty()) {
    throw InputError("expected a unit after the number, such as " + example + found);
  }
  const double in_si = value * factor(unit, si_unit);
  if (!std::isfinite(in_si)) throw InputError("expected a finite number" + found);
  return in_si;
}

double factor_from_si(std::string_view si_unit, std::string_view unit) {
  return factor(si_unit, unit);
}

}  // namespace flexneck
