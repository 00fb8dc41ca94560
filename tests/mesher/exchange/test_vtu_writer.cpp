// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "geometry/foundation/temporary_folder.h"
#include "mesher/exchange/vtu_writer.h"
#include "tests/support/block_mesh.h"
#include "tests/support/element_meshes.h"
#include "tests/support/files.h"
#include "tests/support/run_command.h"

namespace flexneck::mesher {
namespace {

using Catch::Matchers::Contains;

constexpr double kVolume = 0.3 * 0.2 * 0.1;

Mesh box_of(ElementKind kind) {
  return testing::with_kind(
      testing::box({2, 1, 1}, {0.3, 0.2, 0.1}, {"steel", 2e11, 0.3, 7850}).make(), kind);
}

}  // namespace

TEST_CASE("VTK and meshio read every kind of element as it is") {
  const TemporaryFolder folder;
  std::size_t kinds = 0;
  for (const ElementKind kind : element_kinds()) {
    if (dimension(kind) != 3) continue;
    const Mesh mesh = box_of(kind);
    VtuWriter(mesh).write(folder / (std::string(name_of(kind)) + ".vtu"), node_coordinates(mesh),
                          {{"place", node_coordinates(mesh)}});
    ++kinds;
  }
  CHECK(kinds == 11);
  const testing::CommandOutcome outcome = testing::run_shell(
      std::string("/usr/bin/python3 -B ") + FLEXNECK_SOURCE_DIR "/tests/support/check_vtu.py " +
      folder.path().string() + " " + std::to_string(kVolume));
  INFO(outcome.text);
  if (outcome.exit_code == 77) {
    WARN("skipped: " << outcome.text);
  } else {
    CHECK(outcome.exit_code == 0);
  }
}

TEST_CASE("names in a .vtu and a .pvd may hold what XML would take for its own") {
  const TemporaryFolder folder;
  const Mesh mesh = box_of(ElementKind::hex8);
  const std::string name = "a < b & \"c\"";
  VtuWriter(mesh).write(folder / "box.vtu", node_coordinates(mesh),
                        {{name, node_coordinates(mesh)}});
  write_pvd(folder / "box.pvd", {{0, "box.vtu"}, {0.0025, "b&x.vtu"}});
  const std::string escaped = "Name=\"a &lt; b &amp; &quot;c&quot;\"";
  CHECK_THAT(testing::bytes_of(folder / "box.vtu"), Contains(escaped));
  const testing::CommandOutcome outcome = testing::run_shell(
      "/usr/bin/python3 -c \"import xml.etree.ElementTree as e; print([(d.get('timestep'), "
      "d.get('file')) for d in e.parse('" +
      (folder / "box.pvd").string() + "').getroot().iter('DataSet')])\"");
  CHECK(outcome.text == "[('0', 'box.vtu'), ('0.0025', 'b&x.vtu')]\n");
}

}  // namespace flexneck::mesher
