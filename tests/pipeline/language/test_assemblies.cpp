// SPDX-License-Identifier: GPL-3.0-or-later
#include <fstream>

#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "geometry/foundation/temporary_folder.h"
#include "pipeline/language/model/model_file.h"
#include "tests/support/model_text.h"

using Catch::Matchers::Contains;
using namespace flexneck;
using namespace flexneck::pipeline;
using testing::write_test_file;

namespace {

/// A bar with everything that has names, connected to a marker "hook" of the including file.
const std::string kBar = R"(
[[body]]
name = "bar"
kind = "rigid"
mass = "$mass"
center = ["0 m", "$side*0.1 m", "0 m"]
inertia = ["1 kg*m^2", "1 kg*m^2", "1 kg*m^2"]
[[marker]]
body = "bar"
name = "top"
position = ["0 m", "0 m", "0 m"]
[[marker]]
body = "frame"
name = "corner"
position = ["$side*1 m", "0 m", "0 m"]
[[joint]]
name = "pin"
kind = "pin"
lower = "frame.corner"
upper = "bar.top"
axis = [0, 1, 0]
[[motor]]
name = "drive"
joint = "pin"
coordinate = "angle"
initial_rate = "1 rad/s"
[[force]]
name = "push"
marker = "bar.top"
direction = [1, 0, 0]
magnitude = "1 N"
[[torque]]
name = "turn"
marker = "bar.top"
direction = [1, 0, 0]
magnitude = "1 N*m"
[[spring]]
name = "spring"
lower = "frame.centre"
upper = "bar.top"
free_length = "1 m"
[[bushing]]
name = "bush"
lower = "frame.corner"
upper = "bar.top"
[[resistance]]
name = "rub"
joint = "pin"
coordinate = "angle"
[[channel]]
name = "way"
quantity = "position"
marker = "bar.top"
relative_to = "frame.corner"
axes = "frame.centre"
[[channel]]
name = "load"
quantity = "force"
joint = "pin"
[variables]
side = 1
mass = { value = "2 kg", origin = "published", note = "a book" }
)";

const std::string kFrame = R"(
[solver]
end_time = "1 s"
[[body]]
name = "frame"
kind = "ground"
[[marker]]
body = "frame"
name = "centre"
position = ["0 m", "0 m", "0 m"]
)";

std::string assembly(const std::string& name, const std::string& file,
                     const std::string& more = {}) {
  return "[[assembly]]\nname = \"" + name + "\"\nfile = \"" + file + "\"\n" + more;
}

struct Files {
  TemporaryFolder folder;
  Files() { write_test_file(folder / "bar.toml", kBar); }
  ModelFile model(const std::string& text, const std::vector<std::string>& settings = {}) const {
    return read_model_file(write_test_file(folder / "model.toml", text), settings);
  }
};

template <class Named>
std::string joined(const std::vector<Named>& things) {
  std::string text;
  for (const Named& each : things) text += (text.empty() ? "" : " ") + each.name;
  return text;
}

const multibody::RigidBody& rigid(const ModelFile& file, const std::string& name) {
  return std::get<multibody::RigidBody>(file.model.bodies.at(file.model.body_index(name)).kind);
}

std::string parameter(const ModelFile& file, const std::string& key) {
  for (const Parameter& each : file.parameters)
    if (each.key == key) return each.value + ", " + std::string(name_of(each.origin));
  return "none";
}

const std::string kPair = kFrame + assembly("left", "bar.toml", "variables = { side = -1 }\n") +
                          assembly("right", "bar.toml", "[assembly.variables]\nmass = \"3 kg\"\n");

}  // namespace

TEST_CASE("an assembly has all that its file gives, under names and references with its prefix") {
  const Files files;
  const ModelFile file = files.model(kPair);
  const multibody::Model& model = file.model;
  CHECK(joined(model.bodies) == "frame left:bar right:bar");
  CHECK(joined(model.markers) ==
        "frame.centre left:bar.top frame.left:corner right:bar.top frame.right:corner");
  CHECK(joined(model.joints) == "left:pin right:pin");
  CHECK(joined(model.joints[1].motors) == "right:drive");
  CHECK(joined(model.forces.of<multibody::PointForce>()) == "left:push right:push");
  CHECK(joined(model.forces.of<multibody::Torque>()) == "left:turn right:turn");
  CHECK(joined(model.forces.of<multibody::MarkerSpring>()) == "left:spring right:spring");
  CHECK(joined(model.forces.of<multibody::Bushing>()) == "left:bush right:bush");
  CHECK(joined(model.forces.of<multibody::JointResistance>()) == "left:rub right:rub");
  CHECK(joined(file.output.channels) == "left:way left:load right:way right:load");
  const auto marker = [&](std::size_t index) { return model.markers.at(index).name; };
  CHECK(marker(model.joints[1].marker_i) == "frame.right:corner");
  CHECK(marker(model.joints[1].marker_j) == "right:bar.top");
  CHECK(marker(model.forces.of<multibody::PointForce>()[1].marker) == "right:bar.top");
  CHECK(marker(model.forces.of<multibody::Torque>()[1].marker) == "right:bar.top");
  CHECK(marker(model.forces.of<multibody::MarkerSpring>()[1].marker_i) == "frame.centre");
  CHECK(marker(model.forces.of<multibody::Bushing>()[1].marker_i) == "frame.right:corner");
  CHECK(model.forces.of<multibody::JointResistance>()[1].joint == 1);
  CHECK(marker(file.output.channels[2].source) == "right:bar.top");
  CHECK(marker(*file.output.channels[2].relative_to) == "frame.right:corner");
  CHECK(marker(*file.output.channels[2].axes) == "frame.centre");
  CHECK(file.output.channels[3].source == 1);
}

TEST_CASE("each assembly has its own variables, which the command line and provenance name") {
  const Files files;
  const ModelFile file = files.model(kPair);
  CHECK(rigid(file, "left:bar").center_m.y() == Approx(-0.1));
  CHECK(rigid(file, "right:bar").center_m.y() == Approx(0.1));
  CHECK(rigid(file, "left:bar").mass_kg == 2);
  CHECK(rigid(file, "right:bar").mass_kg == 3);
  CHECK(parameter(file, "body.left:bar.mass") == "2 kg, published");
  CHECK(parameter(file, "body.right:bar.mass") == "3 kg, synthetic");
  CHECK(parameter(file, "assembly.left.file") == "bar.toml, synthetic");
  CHECK(parameter(file, "assembly.left.variables.side") == "-1, synthetic");
  CHECK(parameter(file, "assembly.left.variables.mass") == "2 kg, published");
  // Each file is listed once, in the order of reading.
  CHECK(joined(file.files) == "model.toml bar.toml");

  const ModelFile changed =
      files.model(kPair, {"assembly.left.variables.mass=5 kg", "body.right:bar.mass=7 kg"});
  CHECK(rigid(changed, "left:bar").mass_kg == 5);
  CHECK(rigid(changed, "right:bar").mass_kg == 7);
  // Variables of the including file are used.
  const ModelFile given =
      files.model(kFrame + "[variables]\nload = { value = \"4 kg\", origin = \"inferred\" }\n" +
                  assembly("left", "bar.toml", "variables = { mass = \"2*$load\" }\n"));
  CHECK(rigid(given, "left:bar").mass_kg == 8);
  CHECK(parameter(given, "body.left:bar.mass") == "8 kg, inferred");
}

TEST_CASE("assemblies hold assemblies, files of their own folders and what they include") {
  const Files files;
  std::filesystem::create_directory(files.folder / "parts");
  write_test_file(files.folder / "parts/loads.toml",
                  "[[force]]\nname = \"pull\"\nmarker = \"inner:bar.top\"\ndirection = [1, 0, 0]\n"
                  "magnitude = \"1 N\"\n");
  write_test_file(files.folder / "parts/pair.toml",
                  "include = [\"loads.toml\"]\n[variables]\nheavy = \"9 kg\"\n" +
                      assembly("inner", "../bar.toml", "variables = { mass = \"$heavy\" }\n"));
  const std::string text = kFrame + assembly("outer", "parts/pair.toml") + R"([[force]]
name = "mine"
marker = "outer:inner:bar.top"
direction = [1, 0, 0]
magnitude = "1 N"
)";
  const ModelFile file = files.model(text);
  CHECK(joined(file.model.bodies) == "frame outer:inner:bar");
  CHECK(joined(file.model.markers) == "frame.centre outer:inner:bar.top frame.outer:inner:corner");
  CHECK(joined(file.model.forces.of<multibody::PointForce>()) ==
        "mine outer:pull outer:inner:push");
  CHECK(file.model.forces.of<multibody::PointForce>()[1].marker ==
        file.model.forces.of<multibody::PointForce>()[0].marker);
  CHECK(rigid(file, "outer:inner:bar").mass_kg == 9);
  CHECK(joined(file.files) == "model.toml loads.toml pair.toml bar.toml");
  const ModelFile set = files.model(
      text, {"assembly.outer:inner.variables.mass=6 kg", "assembly.outer.variables.heavy=1 kg"});
  CHECK(rigid(set, "outer:inner:bar").mass_kg == 6);
}

TEST_CASE("what an assembly gets wrong is told with file, line, column and key") {
  const Files files;
  const auto refused = [&](const std::string& text, const std::string& why,
                           const std::vector<std::string>& settings = {}) {
    INFO(text);
    CHECK_THROWS_WITH(files.model(kFrame + text, settings), Contains(why) && !Contains("\n"));
  };
  refused(assembly("a", "bar.toml", "fiel = 1\n"), "model.toml:14:8: assembly.a.fiel: unknown key");
  refused("[[assembly]]\nname = \"a\"\n", "model.toml:11:1: assembly.a.file: expected a text");
  refused("[[assembly]]\nfile = \"bar.toml\"\n", "assembly.1.name: expected a text");
  refused(assembly("a:b", "bar.toml"), "expected a name without '.', ':' and '/', found 'a:b'");
  refused(assembly("a", "bar.toml") + assembly("a", "bar.toml"),
          "assembly.a.name: expected a unique name");
  refused(assembly("a", "none.toml"),
          "model.toml:13:8: assembly.a.file: expected a file, but there is none with the name");
  refused(assembly("a", "bar.toml", "variables = { sied = 1 }\n"),
          "model.toml:14:22: assembly.a.variables.sied: expected a variable of");
  refused(assembly("a", "bar.toml", "variables = { mass = \"$m\" }\n"),
          "model.toml:14:22: assembly.a.variables.mass: expected a variable of [variables]");
  refused(assembly("a", "bar.toml"), "--set assembly.b.variables.side=1: there is no [[assembly]]",
          {"assembly.b.variables.side=1"});
  refused("[assembly]\n", "assembly: expected tables [[assembly]]");

  const auto inside = [&](const std::string& content, const std::string& why) {
    write_test_file(files.folder / "part.toml", content);
    refused(assembly("a", "part.toml"), why);
  };
  inside("[solver]\nend_time = \"1 s\"\n", "part.toml:1:1: solver: expected tables [[body]]");
  inside("body = 1\n", "part.toml:1:8: body: expected tables [[body]]");
  inside("[variables]\nx = 1\n",
         "part.toml:2:5: assembly.a.variables.x: expected a value that uses");
  inside(assembly("b", "part.toml"),
         "expected another file, found one that contains this assembly");
  inside(assembly("b", "model.toml"),
         "expected another file, found one that contains this assembly");
  inside("[[force]]\nname = \"f\"\nmarker = \"frame.middle\"\n",
         "part.toml:3:10: force.a:f.marker: ");
}

TEST_CASE("assemblies have an end: 16 within one another, 100 files") {
  const Files files;
  for (int k = 0; k < 20; ++k) {
    const std::string next = std::to_string(k + 1) + ".toml";
    write_test_file(files.folder / (std::to_string(k) + ".toml"),
                    assembly("a", next) + assembly("b", next));
  }
  write_test_file(files.folder / "20.toml", "");
  const std::string why = "expected at most 100 files, nested at most 16 deep";
  CHECK_THROWS_WITH(files.model(kFrame + assembly("a", "0.toml")), Contains(why));
  CHECK_THROWS_WITH(files.model(kFrame + assembly("a", "10.toml")), Contains(why));
  CHECK(joined(files.model(kFrame + assembly("a", "17.toml")).model.bodies) == "frame");
}
