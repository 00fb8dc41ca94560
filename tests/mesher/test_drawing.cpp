// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cairo.h>
#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>
#include <memory>

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "geometry/foundation/temporary_folder.h"
#include "mesher/drawing/body_picture.h"
#include "mesher/drawing/colours.h"
#include "mesher/drawing/picture_sheet.h"
#include "mesher/mesh/boundary.h"
#include "tests/support/block_mesh.h"
#include "tests/support/files.h"

namespace flexneck::mesher {
namespace {

using testing::bytes_of;
namespace fs = std::filesystem;

const Material kMaterial{
    .name = "any", .youngs_modulus_Pa = 1e9, .poissons_ratio = 0.3, .density_kg_m3 = 1000};
constexpr std::uint32_t kWhite = 0xFFFFFF;

Mesh box_of(int x, int y, int z) {
  return testing::box({x, y, z}, Eigen::Vector3d(x, y, z), kMaterial).make();
}

/// Number of pixels that differ from the background.
std::ptrdiff_t covered(const Raster& picture) {
  const auto pixels = picture.pixels();
  return std::count_if(pixels.begin(), pixels.end(),
                       [](std::uint32_t pixel) { return pixel != kWhite; });
}

std::uint32_t pixel_at(const Raster& picture, int x, int y) {
  const int place = y * picture.width() + x;
  return picture.pixels()[static_cast<std::size_t>(place)];
}

/// The pixels of a PNG file.
class SheetPixels {
 public:
  /// First column and row, and number of pixels of a colour.
  struct Found {
    int x = 1 << 20, y = 1 << 20, count = 0;
  };

  explicit SheetPixels(const fs::path& path)
      : picture_(cairo_image_surface_create_from_png(path.c_str()), cairo_surface_destroy) {}

  int width() const { return cairo_image_surface_get_width(picture_.get()); }

  Found find(std::uint32_t colour) const {
    const int stride = cairo_image_surface_get_stride(picture_.get());
    const unsigned char* const bytes = cairo_image_surface_get_data(picture_.get());
    Found found;
    for (int y = 0; y < cairo_image_surface_get_height(picture_.get()); ++y)
      for (int x = 0; x < width(); ++x) {
        std::uint32_t pixel = 0;
        std::memcpy(&pixel, bytes + y * stride + 4 * x, 4);
        if ((pixel & kWhite) != colour) continue;
        found = {std::min(found.x, x), std::min(found.y, y), found.count + 1};
      }
    return found;
  }

 private:
  std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)> picture_;
};

}  // namespace

TEST_CASE("the skin of a box has its outer sides and the box's area") {
  const Mesh mesh = box_of(2, 3, 4);
  const std::vector<Facet> sides = boundary_facets(mesh);
  CHECK(sides.size() == 2 * (2 * 3 + 3 * 4 + 4 * 2));

  const Surface surface = surface_of(mesh);
  Eigen::MatrixX3d nodes(static_cast<Eigen::Index>(mesh.nodes.size()), 3);
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
    nodes.row(static_cast<Eigen::Index>(n)) = Eigen::RowVector3d(mesh.nodes[n].data());
  }
  const Eigen::MatrixX3d x = surface.value * nodes;
  double area = 0;
  double volume = 0;
  for (const auto& t : surface.triangles) {
    const Eigen::Vector3d a = x.row(t[0]);
    const Eigen::Vector3d b = x.row(t[1]);
    const Eigen::Vector3d c = x.row(t[2]);
    const Eigen::Vector3d normal = (b - a).cross(c - a) / 2;
    area += normal.norm();
    volume += normal.dot(a) / 3;
  }
  CHECK(area == Approx(52));
  CHECK(volume == Approx(24));  // the normals point outwards
  CHECK(surface.edges.size() == 4 * sides.size());
  // Twelve edges of the box, each as long as it has elements: 4 (2 + 3 + 4).
  CHECK(surface.outlines.size() == 36);
}

TEST_CASE("a box seen from the front covers its height times its width") {
  const Mesh mesh = box_of(1, 2, 4);
  const BodyPicture plain{.displacement_m = {}, .field = {}, .element_edges = false};
  const View front{{1, 0, 0}};
  const Raster picture = draw_body(mesh, surface_of(mesh), plain, front, 200, 200);
  // A height of four fills the picture except for the margins of 5 %: 180 pixels, half as wide.
  // Lines along the rim are one pixel wide.
  CHECK(covered(picture) >= 180 * 90);
  CHECK(covered(picture) <= 182 * 92);
}

TEST_CASE("what lies nearer to the eye hides what lies behind, whatever is drawn first") {
  const auto square = [](Raster& raster, double depth, const Colour& colour) {
    const std::array<Colour, 3> same = {colour, colour, colour};
    raster.draw_triangle({ScreenPoint(0, 0, depth), {20, 0, depth}, {20, 20, depth}}, same);
    raster.draw_triangle({ScreenPoint(0, 0, depth), {20, 20, depth}, {0, 20, depth}}, same);
  };
  for (const bool near_first : {true, false}) {
    Raster raster(20, 20, {1, 1, 1});
    square(raster, near_first ? 2 : 1, near_first ? Colour(1, 0, 0) : Colour(0, 0, 1));
    square(raster, near_first ? 1 : 2, near_first ? Colour(0, 0, 1) : Colour(1, 0, 0));
    CHECK(pixel_at(raster, 12, 7) == 0xFF0000);
  }
}

TEST_CASE(
    "what reaches far beyond a picture is drawn within it, and what is no number not at all") {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  for (const double far : {30.0, 1e6, 1e9, 1e12}) {
    INFO(far);
    Raster line(20, 20, {1, 1, 1});
    line.draw_line({-far, 10.5, 0}, {far, 10.5, 0}, Colour(0, 0, 0), 1, 0);
    CHECK(covered(line) == 20);
    Raster triangle(20, 20, {1, 1, 1});
    const std::array<Colour, 3> red = {Colour(1, 0, 0), Colour(1, 0, 0), Colour(1, 0, 0)};
    triangle.draw_triangle({ScreenPoint(-far, -far, 0), {far, -far, 0}, {0, far, 0}}, red);
    CHECK(covered(triangle) > 20 * 20 / 2);
  }
  Raster empty(20, 20, {1, 1, 1});
  const std::array<Colour, 3> black = {};
  for (const double none : {kNone, std::numeric_limits<double>::infinity(), 1e300, -1e300}) {
    empty.draw_line({none, 1, 0}, {5, 5, 0}, Colour(0, 0, 0), 1, 0);
    empty.draw_line({1, 5, 0}, {5, -none, 0}, Colour(0, 0, 0), 1, 0);
    empty.draw_triangle({ScreenPoint(none, 1, 0), {5, 5, 0}, {1, none, 0}}, black);
  }
  CHECK(covered(empty) == 0);
  const Mesh mesh = box_of(1, 1, 1);
  const auto n = static_cast<Eigen::Index>(mesh.nodes.size());
  BodyPicture what{.displacement_m = Eigen::Matrix3Xd::Zero(3, n),
                   .field = Eigen::VectorXd::Zero(n),
                   .element_edges = false};
  what.displacement_m(1, 3) = kNone;
  CHECK_THROWS_AS(draw_body(mesh, surface_of(mesh), what, {{1, 0, 0}}, 50, 50), ComputationError);
  what.displacement_m.setZero();
  what.field[2] = kNone;
  CHECK_THROWS_AS(draw_body(mesh, surface_of(mesh), what, {{1, 0, 0}}, 50, 50), ComputationError);
}

TEST_CASE("displacements move the picture and a field colours it") {
  const Mesh mesh = box_of(1, 1, 1);
  const Surface surface = surface_of(mesh);
  const auto n = static_cast<Eigen::Index>(mesh.nodes.size());
  BodyPicture what{.displacement_m = Eigen::Matrix3Xd::Zero(3, n),
                   .field = Eigen::VectorXd::Zero(n),
                   .element_edges = false};
  what.displacement_m.row(1).setConstant(0.5);
  const View front{{1, 0, 0}};  // y runs to the right
  const Raster picture = draw_body(mesh, surface, what, front, 200, 200, 0.5);
  // The box, 90 pixels wide at this scale, has moved by 45 from the middle.
  CHECK(pixel_at(picture, 95, 100) == kWhite);
  CHECK(pixel_at(picture, 110, 100) != kWhite);
  CHECK(pixel_at(picture, 185, 100) != kWhite);

  what.field.setOnes();
  const std::uint32_t high =
      pixel_at(draw_body(mesh, surface, what, front, 200, 200, 0.5), 145, 100);
  const Colour yellow = scale_colour(1);
  const auto red = static_cast<float>(high >> 16U);
  const auto blue = static_cast<float>(high & 0xFFU);
  CHECK(red / blue == Approx(yellow[0] / yellow[2]).epsilon(0.05));  // shaded, of the same hue
}

TEST_CASE("a sheet is a PNG file, the same each time, and nothing is left where it fails") {
  const TemporaryFolder folder;
  const Mesh mesh = box_of(1, 1, 2);
  PictureSheet sheet;
  sheet.panels.push_back({"box", draw_body(mesh, surface_of(mesh), {}, {}, 120, 120)});
  sheet.legend = {{"any", category_colour(0)}};
  sheet.scale = ScaleBar{"0", "1"};
  write_png(folder / "a.png", sheet);
  write_png(folder / "b.png", sheet);
  CHECK(bytes_of(folder / "a.png").substr(1, 3) == "PNG");
  CHECK(bytes_of(folder / "a.png") == bytes_of(folder / "b.png"));
  CHECK_THROWS_AS(write_png(folder / "none" / "c.png", sheet), InputError);
  CHECK(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()) == 2);
}

TEST_CASE("entries of a legend stand side by side, each with its whole patch of colour") {
  const TemporaryFolder folder;
  PictureSheet sheet;
  sheet.panels.push_back({"", Raster(400, 40, Colour(1, 1, 1))});
  sheet.legend = {{"first of three", Colour(1, 0, 0)},
                  {"second", Colour(0, 1, 0)},
                  {"third one", Colour(0, 0, 1)}};
  write_png(folder / "sheet.png", sheet);
  const SheetPixels pixels(folder / "sheet.png");
  int last_x = -1;
  for (const std::uint32_t colour : {0xFF0000U, 0x00FF00U, 0x0000FFU}) {
    const SheetPixels::Found patch = pixels.find(colour);
    CHECK(patch.count >= 12 * 13);  // its left and right edges may share a pixel with the ground
    CHECK(patch.x > last_x + 13);
    last_x = patch.x;
  }
}

TEST_CASE("panels of a sheet stand in rows below each other, with their titles above") {
  const TemporaryFolder folder;
  constexpr int kSize = 60;
  const std::array colours = {Colour(1, 0, 0), Colour(0, 1, 0), Colour(0, 0, 1)};
  PictureSheet sheet{.panels = {}, .columns = 2, .caption = {}, .legend = {}, .scale = {}};
  for (const Colour& colour : colours) sheet.panels.push_back({"", Raster(kSize, kSize, colour)});
  write_png(folder / "sheet.png", sheet);
  const SheetPixels pixels(folder / "sheet.png");
  const SheetPixels::Found red = pixels.find(0xFF0000);
  const SheetPixels::Found green = pixels.find(0x00FF00);
  const SheetPixels::Found blue = pixels.find(0x0000FF);
  for (const SheetPixels::Found& each : {red, green, blue}) CHECK(each.count == kSize * kSize);
  CHECK(green.x == red.x + kSize);
  CHECK(green.y == red.y);
  CHECK(blue.x == red.x);
  CHECK(blue.y > red.y + kSize);
  CHECK(pixels.width() == 2 * (red.x + kSize));  // as much margin on the right
}

}  // namespace flexneck::mesher
