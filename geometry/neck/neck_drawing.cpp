// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/neck/neck_drawing.h"

#include <algorithm>
#include <cmath>

#include "geometry/foundation/output_file.h"
#include "geometry/foundation/units.h"

namespace flexneck::geometry {
namespace {

constexpr double kWidestColumns = 44;
constexpr double kMaxRows = 50;
constexpr double kCharacterHeight = 2;  ///< in character widths

struct Slice {
  const NeckLayer* layer;
  double x_m, z_m;  ///< centre of the character
  double row_m;     ///< height of a row of characters
};

bool is_slit(const NeckSlits& slits, const NeckParameters& neck, const Slice& at) {
  if (slits.state == SlitState::none) return false;
  const bool is_cut =
      std::find(slits.parts.begin(), slits.parts.end(), at.layer->part) != slits.parts.end();
  const double middle_m = at.layer->bottom_m + at.layer->thickness_m / 2;
  // The slit is drawn in the row that contains the mid-height, its upper end included.
  const double above_m = at.z_m + at.row_m / 2 - middle_m;
  const double rim_m = at.layer->offset_m + at.layer->diameter_m / 2;
  const double edge_m = rim_m - slits.depth.value_or(0) * (rim_m - neck.hole_diameter / 2);
  return is_cut && above_m >= 0 && above_m < at.row_m && at.x_m > edge_m && at.x_m < rim_m;
}

char character_at(const NeckParameters& neck, const NeckSlits& slits, const Slice& at) {
  if (std::abs(at.x_m) < neck.hole_diameter / 2) return ' ';
  if (std::abs(at.x_m - at.layer->offset_m) > at.layer->diameter_m / 2) return ' ';
  if (!at.layer->is_rubber) return '#';
  if (is_slit(slits, neck, at)) return slits.state == SlitState::open ? '-' : '=';
  return ':';
}

std::string label_of(const NeckLayer& layer) {
  constexpr std::size_t kPartWidth = 10, kNumberWidth = 7;
  std::string part = layer.part;
  part.resize(std::max(part.size(), kPartWidth), ' ');
  std::string number = rounded_text(layer.thickness_m * factor_from_si("m", "in"), 4);
  number.insert(0, kNumberWidth - std::min(number.size(), kNumberWidth), ' ');
  return "  " + part + " " + number + " in";
}

}  // namespace

std::string drawn_section(const NeckParameters& neck, const NeckSlits& slits) {
  const std::vector<NeckLayer> layers = layers_of(neck);
  const double column_m =
      std::max(neck.plate_diameter / kWidestColumns, neck.length / (kMaxRows * kCharacterHeight));
  const auto columns = static_cast<int>(std::lround(neck.plate_diameter / column_m));
  const auto rows =
      std::max(1, static_cast<int>(std::lround(neck.length / (column_m * kCharacterHeight))));
  const double row_m = neck.length / rows;
  std::vector<std::string> lines;
  for (int r = 0; r < rows; ++r) {
    const double z_m = (rows - r - 0.5) * row_m;
    const auto above = std::find_if(layers.begin(), layers.end(),
                                    [&](const NeckLayer& layer) { return layer.bottom_m > z_m; });
    const NeckLayer& layer = *(above - 1);
    std::string line = "  ";
    for (int c = 0; c < columns; ++c) {
      const double x_m = (c + 0.5) * column_m - neck.plate_diameter / 2;
      line += character_at(neck, slits, {&layer, x_m, z_m, row_m});
    }
    lines.push_back(line);
  }
  for (const NeckLayer& layer : layers) {
    const double from_top_m = neck.length - layer.bottom_m - layer.thickness_m / 2;
    const auto row = std::min(static_cast<std::size_t>(from_top_m / row_m), lines.size() - 1);
    lines[row] += label_of(layer);
  }
  std::string drawing;
  for (std::string& line : lines) {
    line.erase(line.find_last_not_of(' ') + 1);
    drawing += line + "\n";
  }
  const std::string front =
      "back" + std::string(static_cast<std::size_t>(std::max(1, columns - 9)), ' ');
  return drawing + "  " + front + "front";
}

}  // namespace flexneck::geometry
