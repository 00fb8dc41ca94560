// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/drawing/picture_sheet.h"

#include <algorithm>
#include <cairo.h>
#include <exception>
#include <memory>
#include <string>

#include "geometry/foundation/error.h"
#include "geometry/foundation/output_file.h"
#include "mesher/drawing/colours.h"

namespace flexneck::mesher {
namespace {

constexpr int kTitleHeight = 30;
constexpr int kFooterHeight = 40;
constexpr int kPadding = 14;
constexpr double kTitleSize = 15;
constexpr double kTextSize = 13;

struct Destroy {
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
  void operator()(cairo_t* canvas) const { cairo_destroy(canvas); }
};
using CairoSurface = std::unique_ptr<cairo_surface_t, Destroy>;
using Canvas = std::unique_ptr<cairo_t, Destroy>;

void use(cairo_t* canvas, const Colour& colour) {
  cairo_set_source_rgb(canvas, colour[0], colour[1], colour[2]);
}

enum class Anchor { left, centre, right };

/// Writes one line of text; returns its width.
double write(cairo_t* canvas, const std::string& text, double x, double baseline, double size,
             Anchor anchor) {
  cairo_select_font_face(canvas, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(canvas, size);
  cairo_text_extents_t extents;
  cairo_text_extents(canvas, text.c_str(), &extents);
  const double back = anchor == Anchor::left     ? 0
                      : anchor == Anchor::centre ? extents.x_advance / 2
                                                 : extents.x_advance;
  use(canvas, Colour(0.1F, 0.1F, 0.12F));
  cairo_move_to(canvas, x - back, baseline);
  cairo_show_text(canvas, text.c_str());
  return extents.x_advance;
}

void paint(cairo_t* canvas, const Raster& picture, double x, double y) {
  std::vector<std::uint32_t> pixels = picture.pixels();
  // A row of 32-bit pixels has no padding, so Cairo can use the picture's own rows.
  const CairoSurface image(cairo_image_surface_create_for_data(
      reinterpret_cast<unsigned char*>(pixels.data()), CAIRO_FORMAT_RGB24, picture.width(),
      picture.height(), 4 * picture.width()));
  cairo_set_source_surface(canvas, image.get(), x, y);
  cairo_paint(canvas);
  cairo_set_source_rgb(canvas, 1, 1, 1);  // releases the image before it is destroyed
}

/// Draws the colour scale from the right edge towards the left.
void draw_scale(cairo_t* canvas, const ScaleBar& scale, double right, double baseline) {
  constexpr int kWidth = 160;
  double x = right - write(canvas, scale.high, right, baseline, kTextSize, Anchor::right) - 6;
  for (int i = 0; i < kWidth; ++i) {
    use(canvas, scale_colour(1 - i / (kWidth - 1.0)));
    cairo_rectangle(canvas, x - i - 1, baseline - 11, 1.5, 13);
    cairo_fill(canvas);
  }
  x -= kWidth + 6;
  write(canvas, scale.low, x, baseline, kTextSize, Anchor::right);
}

void draw_legend(cairo_t* canvas, const std::vector<LegendEntry>& legend, double right,
                 double baseline) {
  for (std::size_t k = legend.size(); k-- > 0;) {
    const LegendEntry& entry = legend[k];
    right -= write(canvas, entry.label, right, baseline, kTextSize, Anchor::right) + 6;
    use(canvas, entry.colour);
    cairo_rectangle(canvas, right - 13, baseline - 11, 13, 13);
    cairo_fill(canvas);
    right -= 13 + 18;
  }
}

void draw_sheet(cairo_t* canvas, const PictureSheet& sheet, int width, int height) {
  cairo_set_source_rgb(canvas, 1, 1, 1);
  cairo_paint(canvas);
  const int panel_width = sheet.panels.front().picture.width();
  const int panel_height = sheet.panels.front().picture.height() + kTitleHeight;
  for (std::size_t p = 0; p < sheet.panels.size(); ++p) {
    const Panel& panel = sheet.panels[p];
    const int column = static_cast<int>(p) % sheet.columns;
    const int row = static_cast<int>(p) / sheet.columns;
    const double x = kPadding + column * panel_width;
    const double y = kPadding + row * panel_height;
    paint(canvas, panel.picture, x, y + kTitleHeight);
    write(canvas, panel.title, x + panel_width / 2.0, y + 20, kTitleSize, Anchor::centre);
  }
  const double baseline = height - 16;
  write(canvas, sheet.caption, kPadding, baseline, kTextSize, Anchor::left);
  if (sheet.scale) draw_scale(canvas, *sheet.scale, width - kPadding, baseline);
  draw_legend(canvas, sheet.legend, width - kPadding, baseline);
}

/// Callback of Cairo. Cairo is C, so no exception may pass through it.
cairo_status_t append(void* png, const unsigned char* bytes, unsigned int size) noexcept {
  try {
    static_cast<std::string*>(png)->append(reinterpret_cast<const char*>(bytes), size);
    return CAIRO_STATUS_SUCCESS;
  } catch (const std::exception&) {
    return CAIRO_STATUS_NO_MEMORY;
  }
}

void require_success(cairo_status_t status, const std::filesystem::path& path) {
  if (status == CAIRO_STATUS_SUCCESS) return;
  throw ComputationError(path.string() +
                         ": the picture cannot be written: " + cairo_status_to_string(status));
}

}  // namespace

void write_png(const std::filesystem::path& path, const PictureSheet& sheet) {
  if (sheet.panels.empty())
    throw ComputationError(path.string() + ": expected at least one picture, found none");
  const int rows = (static_cast<int>(sheet.panels.size()) + sheet.columns - 1) / sheet.columns;
  const Raster& first = sheet.panels.front().picture;
  const int width = 2 * kPadding + sheet.columns * first.width();
  const int height = 2 * kPadding + rows * (first.height() + kTitleHeight) + kFooterHeight;
  const CairoSurface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height));
  const Canvas canvas(cairo_create(surface.get()));
  draw_sheet(canvas.get(), sheet, width, height);
  require_success(cairo_status(canvas.get()), path);

  std::string png;
  require_success(cairo_surface_write_to_png_stream(surface.get(), append, &png), path);
  write_text(path, png, Durability::none);
}

}  // namespace flexneck::mesher
