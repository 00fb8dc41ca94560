// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/foundation/output_file.h"
#include "pipeline/language/study/sections.h"

namespace flexneck::pipeline {

namespace {

constexpr Key kMaterialKeys[] = {
    Key::quantity("youngs_modulus", "Pa", kRequired, "Young's modulus", {.range = kPositive}),
    Key::number("poissons_ratio", kRequired, "Poisson's ratio"),
    Key::quantity("density", "kg/m^3", kRequired, "Mass density (a weight density is refused)",
                  {.range = kPositive}),
    Key::texts("parts", kRequired, "Parts of the mesh that consist of the material"),
    Key::text("formulation", kNone, "Formulation of the elements (default: that of [modes])",
              {.used_by = UsedBy::modes}),
    Key::number("static_modulus_ratio", "1",
                "Ratio of Young's modulus in static tests to that of the modes",
                {.range = kPositive, .used_by = UsedBy::modes}),
};

constexpr Key kMaterialsKeys[] = {
    Key::table("*", "Material with this name", kMaterialKeys),
};

}  // namespace

std::span<const Key> materials_keys() { return kMaterialsKeys; }

MaterialModels read_materials(const StudyTable& geometry, std::vector<mesher::Material>& materials,
                              std::map<std::string, std::string>& material_of_part) {
  MaterialModels models;
  const StudyTable table = geometry.table("materials");
  for (const std::string& name : table.keys()) {
    const StudyTable material = table.table(name);
    materials.push_back({name, material.quantity("youngs_modulus"),
                         material.number("poissons_ratio"), material.quantity("density")});
    const double ratio = materials.back().poissons_ratio;
    if (!(ratio > -1 && ratio < 0.5))
      material.refuse("poissons_ratio",
                      "expected a value between -1 and 0.5, found " + exact_text(ratio));
    MaterialModel& model = models[name];
    if (material.has("formulation")) model.formulation = read_formulation(material);
    model.static_modulus_ratio = material.number("static_modulus_ratio");
    for (const std::string& part : material.texts("parts")) {
      const auto [known, is_new] = material_of_part.emplace(part, name);
      if (!is_new) {
        const std::string& other = known->second;
        material.refuse("parts",
                        "part '" + part + "' already belongs to material '" + other +
                            "'; remove it there, e.g. with parts = [] in [geometry.materials." +
                            other + "]");
      }
    }
    material.finish();
  }
  return models;
}

}  // namespace flexneck::pipeline
