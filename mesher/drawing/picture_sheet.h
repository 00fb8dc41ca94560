// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "mesher/drawing/raster.h"

namespace flexneck::mesher {

struct Panel {
  std::string title;
  Raster picture;
};

struct LegendEntry {
  std::string label;
  Colour colour;
};

/// A colour scale with the labels of its ends.
struct ScaleBar {
  std::string low, high;
};

/// Pictures of equal size in rows, with titles, a caption below, and a legend or a scale.
struct PictureSheet {
  std::vector<Panel> panels;
  int columns = 1;
  std::string caption;
  std::vector<LegendEntry> legend;
  std::optional<ScaleBar> scale;
};

/// Writes a PNG file, under a temporary name first. The same sheet gives the same bytes.
/// @throws ComputationError if the file cannot be written.
void write_png(const std::filesystem::path& path, const PictureSheet& sheet);

}  // namespace flexneck::mesher
