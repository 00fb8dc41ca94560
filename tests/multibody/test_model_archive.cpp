// SPDX-License-Identifier: GPL-3.0-or-later
// Serialisation of a model, as an FMU carries it.
#include <string>
#include <string_view>

#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "multibody/files/model_archive.h"
#include "tests/support/tree_models.h"

using Catch::Matchers::Contains;
using namespace flexneck;
using namespace flexneck::multibody;

namespace {

/// A model with every kind of body, joint and force that can be archived.
Model model_of_all_kinds() {
  Model model = testing::forest(true);
  const std::size_t i = model.marker_index("d end");
  const std::size_t j = model.marker_index("k g");
  Section section{"section", i, j, {0, 0, 0.2}, Section::Stiffness::Identity(8, 8)};
  section.branches = {{Section::Stiffness::Identity(8, 8), 0.03}};
  section.bending_curve = LoadCurve::table({0, 0.1, 0.5}, {0, 2, 14});
  model.forces.add(section);
  model.forces.add(Cable{"cable", i, j, Eigen::Vector3d::UnitX(), 0.1, 5, 40, 0.01});
  model.forces.add(LineForce{"actuator", i, j, testing::constant_table(4)});
  const Model joints = testing::chain_of_all_joints();
  model.joints.insert(model.joints.end(), joints.joints.begin(), joints.joints.end());
  model.start.internal = Eigen::VectorXd::LinSpaced(8, 0, 1);
  return model;
}

std::string bytes_of(Model& model) {
  ByteWriter writer;
  archive(writer, model);
  return writer.bytes();
}

Model model_of(std::string_view bytes) {
  ByteReader reader(bytes);
  Model model;
  archive(reader, model);
  reader.finish();
  return model;
}

}  // namespace

TEST_CASE("a model of every kind comes back from its bytes, and from no beginning of them") {
  Model model = model_of_all_kinds();
  const std::string bytes = bytes_of(model);
  Model found = model_of(bytes);
  CHECK(bytes_of(found) == bytes);
  found.forces.each_kind([&]<class Kind>(const std::vector<Kind>& elements) {
    CAPTURE(Kind::kName);
    CHECK(elements.size() == model.forces.of<Kind>().size());
    CHECK(elements.empty() == std::is_same_v<Kind, FunctionForce>);
  });
  CHECK(found.forces.of<Cable>()[0].play_m == 0.01);
  CHECK(found.forces.of<Section>()[0].bending_curve.value(0.3) ==
        model.forces.of<Section>()[0].bending_curve.value(0.3));
  CHECK(found.joints.back().kind == model.joints.back().kind);
  for (std::size_t size = 0; size < bytes.size(); size += 101)
    REQUIRE_THROWS_AS(model_of(std::string_view(bytes).substr(0, size)), InputError);
  CHECK_THROWS_AS(model_of(bytes + "x"), InputError);
}

TEST_CASE("a force that is a function of the program is refused by its name") {
  Model model;
  model.forces.add(FunctionForce{"prototype", 0, 1,
                                 [](double, const RelativeMotion&) { return FunctionLoad{}; }});
  CHECK_THROWS_WITH(bytes_of(model), Contains("prototype") && Contains("function"));
}
