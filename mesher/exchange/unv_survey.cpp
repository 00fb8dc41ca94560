// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <sstream>
#include <string>
#include <vector>

#include "mesher/exchange/file_survey.h"
#include "mesher/exchange/text_lines.h"

namespace flexneck::mesher {
namespace {

constexpr int kUnits = 164;
constexpr int kNodes = 2411;
constexpr int kElements = 2412;

/// Data sets that add nothing to the structure by themselves: headers, units, coordinate systems,
/// nodes, elements, groups, materials, results.
constexpr std::array<int, 27> kSilent = {15,   18,   55,   56,   57,   58,   151,  156,  kUnits,
                                         1705, 1710, 2400, 2411, 2412, 2414, 2420, 2429, 2430,
                                         2432, 2435, 2437, 2448, 2452, 2467, 2477, 772,  789};
/// Tables of properties: the thickness of shells, the section of beams.
constexpr std::array<int, 3> kProperties = {772, 2437, 2448};

template <std::size_t N>
bool is_among(const std::array<int, N>& numbers, int number) {
  return std::find(numbers.begin(), numbers.end(), number) != numbers.end();
}

/// Numbers between blanks, up to the first that is none; exponents may be written with a D.
template <class Number>
std::vector<Number> numbers_in(std::string_view line) {
  std::string text(line);
  std::replace(text.begin(), text.end(), 'D', 'E');
  std::istringstream stream(text);
  std::vector<Number> numbers;
  for (Number number = 0; stream >> number;) numbers.push_back(number);
  return numbers;
}

/// Elements by the number of I-deas' kind of element, its FE descriptor.
bool is_solid(int descriptor) { return descriptor > 100 && descriptor < 120; }
bool is_beam(int descriptor) { return descriptor < 40; }
bool is_shell(int descriptor) { return descriptor > 40 && descriptor < 100; }

class Surveyor {
 public:
  Surveyor(double length_unit_m, LeftOut& left_out)
      : length_unit_m_(length_unit_m), left_out_(&left_out) {}

  void read(int data_set, const std::vector<std::string_view>& lines) {
    if (data_set == kNodes) survey_.nodes += lines.size() / 2;
    if (data_set == kElements) add_elements(lines);
    if (data_set == kUnits) compare_units(lines);
    has_properties_ = has_properties_ || is_among(kProperties, data_set);
    if (!is_among(kSilent, data_set)) {
      left_out_->add("data set " + std::to_string(data_set));
    }
  }

  FileSurvey finish() {
    if (has_properties_) {
      left_out_->add("shells", shells_);
      left_out_->add("beams and rods", beams_);
    }
    return survey_;
  }

 private:
  /// A line of label, descriptor, property, material, colour and number of nodes; for beams one of
  /// their sections; then the nodes, eight a line.
  void add_elements(const std::vector<std::string_view>& lines) {
    for (std::size_t line = 0; line < lines.size();) {
      const std::vector<int> head = numbers_in<int>(lines[line]);
      if (head.size() < 6 || head[5] < 1) return;  // gmsh stops here too
      const int descriptor = head[1];
      const auto nodes = static_cast<std::size_t>(head[5]);
      line += 1 + (is_beam(descriptor) ? 1 : 0) + (nodes + 7) / 8;
      if (is_solid(descriptor)) {
        ++survey_.solids[nodes];
      } else if (is_shell(descriptor)) {
        ++shells_;
      } else if (is_beam(descriptor)) {
        ++beams_;
      } else {
        left_out_->add("elements of descriptor " + std::to_string(descriptor));
      }
    }
  }

  /// The second line begins with what a metre counts.
  void compare_units(const std::vector<std::string_view>& lines) {
    if (lines.size() < 2) return;
    const std::vector<double> factors = numbers_in<double>(lines[1]);
    if (factors.empty() || std::abs(factors[0] * length_unit_m_ - 1) < 1e-3) return;
    std::array<char, 160> text{};
    std::snprintf(text.data(), text.size(),
                  "data set 164 says that lengths count %.4g to the metre, the study's unit %.4g",
                  factors[0], 1 / length_unit_m_);
    left_out_->remark(text.data());
  }

  double length_unit_m_;
  LeftOut* left_out_;
  bool has_properties_ = false;
  std::size_t shells_ = 0;
  std::size_t beams_ = 0;
  FileSurvey survey_;
};

bool is_delimiter(std::string_view line) { return trimmed(line) == "-1"; }

}  // namespace

FileSurvey survey_unv(std::string_view text, double length_unit_m, LeftOut& left_out) {
  Surveyor surveyor(length_unit_m, left_out);
  TextLines lines(text);
  while (auto line = lines.next()) {
    if (!is_delimiter(*line)) continue;
    line = lines.next();
    if (!line) break;
    const std::vector<int> number = numbers_in<int>(*line);
    std::vector<std::string_view> body;
    while ((line = lines.next()) && !is_delimiter(*line)) body.push_back(*line);
    if (!number.empty()) surveyor.read(number[0], body);
  }
  return surveyor.finish();
}

}  // namespace flexneck::mesher
