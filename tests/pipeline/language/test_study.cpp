// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>

#include <Eigen/Core>
#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "geometry/foundation/temporary_folder.h"
#include "pipeline/language/study/study.h"
#include "tests/support/dense_solvers.h"

using Catch::Matchers::Contains;
using Catch::Matchers::EndsWith;
using namespace flexneck;
using namespace flexneck::pipeline;

namespace {

Study built_in(const std::vector<std::string>& settings = {}) {
  return read_study(built_in_study(), settings);
}

/// True for parameters that affect a physical result; names, directions and numerical settings do
/// not.
bool is_physical(const Parameter& parameter) {
  const std::vector<std::string> plain = {"name",      "kind",   "body",  "lower",
                                          "upper",     "parts",  "modes", "marker",
                                          "direction", "bodies", "forces"};
  const std::string key = parameter.key.substr(parameter.key.rfind('.') + 1);
  return std::find(plain.begin(), plain.end(), key) == plain.end();
}

}  // namespace

TEST_CASE("every shipped study reads, and its dimensions say where they come from") {
  for (const std::string name : {"hybrid3", "hybrid3_a", "hybrid3_b", "hybrid3_c_prime"}) {
    INFO(name);
    const Study study = read_study(built_in_study().parent_path() / (name + ".toml"), {});
    REQUIRE(study.neck());
    CHECK(study.cases.size() == 49);  // 3 static, 11 pendulum, 35 variants
    for (const Parameter& parameter : study.parameters) {
      if (!parameter.key.starts_with("geometry.") || !is_physical(parameter)) continue;
      const bool is_file =
          parameter.key == "geometry.script" || parameter.key == "geometry.fitted_to";
      INFO(parameter.key);
      CHECK((is_file || parameter.origin != Origin::synthetic));
    }
  }
}

TEST_CASE("a neck with a dimension of the user's own no longer counts as fitted") {
  CHECK(built_in().neck()->fitted_to.size() == 3);
  CHECK(built_in({"geometry.plate_thickness=0.33 in"}).neck()->fitted_to.empty());
  CHECK(built_in({"mesh.quadrant=6"}).neck()->fitted_to.size() == 3);
  const auto fits_with_slits = [](const std::string& state) {
    return built_in({"geometry.slits=" + state, "geometry.slit_depth=0.5", "mesh.rubber_layers=4"})
        .neck()
        ->fitted_to.size();
  };
  CHECK(fits_with_slits("none") == 3);
  CHECK(fits_with_slits("closed") == 3);  // tied shut: the same neck
  CHECK(fits_with_slits("open") == 0);

  // A changed dimension counts whatever origin the user gives it.
  const TemporaryFolder folder;
  for (const char* const line :
       {"[geometry]\nplate_thickness = { value = \"0.4 in\", origin = \"published\" }",
        "[geometry.materials.butyl]\ndensity = { value = \"1100 kg/m^3\", origin = \"inferred\" "
        "}"}) {
    std::ofstream(folder / "mine.toml") << "include = [\"" << built_in_study().string() << "\"]\n"
                                        << line << "\n";
    INFO(line);
    CHECK(read_study(folder / "mine.toml", {}).neck()->fitted_to.empty());
  }
}

TEST_CASE("a fit that names its values by their hash holds for these alone, wherever they stand") {
  const TemporaryFolder folder;
  const auto write = [&](const std::string& name, const std::string& text) {
    std::ofstream(folder / name) << text;
    return folder / name;
  };
  // Dimensions of the user, one of them by a variable, with that file's hash.
  const std::string mine = "include = [\"" + built_in_study().string() +
                           "\"]\n[variables]\nthick = \"0.4 in\"\n[geometry]\n"
                           "plate_thickness = \"$thick\"\nfitted_to = [\"bending 1\"]\n";
  const Study unnamed = read_study(write("unnamed.toml", mine), {});
  CHECK(unnamed.neck()->fitted_to.empty());
  const std::filesystem::path fitted = write(
      "fitted.toml", mine + "fitted_values = \"" + neck_values_hash(unnamed.parameters) + "\"\n");
  const auto holds = [&](const std::filesystem::path& study,
                         const std::vector<std::string>& settings = {}) {
    return !read_study(study, settings).neck()->fitted_to.empty();
  };
  CHECK(holds(fitted));
  CHECK(holds(fitted, {"mesh.quadrant=6", "body.neck.damping_ratio=0.5"}));
  CHECK_FALSE(holds(fitted, {"geometry.top_plate_thickness=0.3 in"}));
  CHECK_FALSE(holds(fitted, {"variables.thick=0.41 in"}));
  // Values changed by a file that includes it, whatever origin it gives.
  const std::string include = "include = [\"fitted.toml\"]\n";
  CHECK(holds(write("same.toml", include)));
  for (const char* const change :
       {"[geometry]\ntop_plate_thickness = { value = \"0.3 in\", origin = \"published\" }\n",
        "[variables]\nthick = { value = \"0.41 in\", origin = \"published\" }\n",
        "[geometry.materials.butyl]\ndensity = { value = \"1100 kg/m^3\", origin = \"inferred\" "
        "}\n",
        "[[interface]]\nname = \"top\"\nposition = [\"0 in\", \"0 in\", \"6 in\"]\n"}) {
    INFO(change);
    CHECK_FALSE(holds(write("changed.toml", include + change)));
  }
}

TEST_CASE("a preset gives the divisions that are not given otherwise") {
  const auto divisions = [](const std::vector<std::string>& settings) {
    return built_in(settings).neck()->divisions;
  };
  CHECK(geometry::hexahedra(divisions({})) == 896);
  CHECK(geometry::hexahedra(divisions({"mesh.preset=paper"})) == 2400);
  CHECK(divisions({"mesh.preset=paper"}).ring_grading == 1);
  const geometry::NeckDivisions mixed =
      divisions({"mesh.preset=paper", "mesh.rubber_layers=4", "mesh.refine=1"});
  CHECK(mixed.quadrant == 6);
  CHECK(mixed.rubber_layers == 4);
  CHECK(mixed.refine == 1);
  CHECK_THROWS_WITH(built_in({"mesh.preset=papr"}), Contains("did you mean 'paper'?"));
}

TEST_CASE("elements and slits are read, or refused with what there is") {
  using geometry::SlitState;
  using mesher::ElementKind;
  const auto element = [](const Study& study) {
    return std::get<mesher::ScriptMeshOptions>(study.structure->source).element;
  };
  CHECK(element(built_in()) == ElementKind::hex27);
  CHECK(element(built_in({"mesh.element=tet10"})) == ElementKind::tet10);
  CHECK_THROWS_WITH(built_in({"mesh.element=hex21"}), Contains("did you mean 'hex2"));
  CHECK(built_in().neck()->slits.state == SlitState::none);
  CHECK_FALSE(built_in().neck()->slits.depth);

  const std::vector<std::string> open = {"geometry.slits=open", "mesh.rubber_layers=4",
                                         "geometry.slit_parts=[\"rubber_1\"]"};
  const auto with = [&](const std::string& setting) {
    std::vector<std::string> settings = open;
    settings.push_back(setting);
    return built_in(settings).neck()->slits;
  };
  CHECK(with("geometry.slit_depth=0.25").state == SlitState::open);
  CHECK(with("geometry.slit_depth=0.25").depth == 0.25);
  CHECK(with("geometry.slit_depth=0.25").parts == std::vector<std::string>{"rubber_1"});
  CHECK_THROWS_WITH(built_in(open), Contains("slits need slit_depth"));
  CHECK_THROWS_WITH(with("geometry.slit_depth=1.25"), Contains("0 < slit_depth < 1, found 1.25"));
  CHECK_THROWS_WITH(with("geometry.slit_edge=chord"), Contains("no straight line"));
}

TEST_CASE("the head's inertia is the published principal one, turned") {
  const Study study = built_in();
  const Eigen::Matrix3d inertia = study.rigid_body("head").inertia_kg_m2;
  const Eigen::Vector3d principal = testing::symmetric_eigenvalues(inertia);
  // GEBOD: 0.1408, 0.1956, 0.2128 lbf s^2 in; the tensor in the study has four digits.
  const double unit = 0.45359237 * 9.80665 * 0.0254;
  CHECK(principal[0] / unit == Approx(0.1408).epsilon(5e-4));
  CHECK(principal[1] / unit == Approx(0.1956).epsilon(5e-4));
  CHECK(principal[2] / unit == Approx(0.2128).epsilon(5e-4));
}

TEST_CASE("cases take what they do not say from their kind, variants from their cases") {
  const Study study = built_in({"pendulum.duration=0.25 s", "case.flexion-20.duration=0.5 s",
                                "variant.duration.pulse=extension"});
  const auto named = [&](const std::string& name) {
    for (const CaseSection& each : study.cases)
      if (each.name == name) return each;
    throw std::runtime_error("no case " + name);
  };
  CHECK(named("flexion-40").duration_s == 0.25);
  CHECK(named("flexion-20").duration_s == 0.5);
  const CaseSection variant = named("flexion-20-duration");
  CHECK(variant.variant_of == "flexion-20");
  CHECK(variant.duration_s == 0.5);
  CHECK(variant.pulse == "extension");
  CHECK(variant.pulse_scaling == PulseFit::duration);
  CHECK(variant.impact_velocity_m_s == named("flexion-20").impact_velocity_m_s);
  CHECK(named("lateral-65-rigid").direction == CaseSection::Direction::lateral);
  // A pendulum that falls through 60 degrees on 65.48 in: v^2 = g L.
  CHECK(named("flexion-60").impact_velocity_m_s ==
        Approx(std::sqrt(9.80665 * 65.48 * 0.0254)).epsilon(1e-12));
  // Each value occurs once among the parameters, where the study gives it.
  const auto count = std::count_if(study.parameters.begin(), study.parameters.end(), [](auto& p) {
    return p.key == "variant.rigid.body.neck.mass" || p.key == "pendulum.pivot_distance";
  });
  CHECK(count == 2);
}

TEST_CASE("an experiment that cannot be is refused with what there is") {
  CHECK_THROWS_WITH(built_in({"variant.rigid.of=[\"flexoin-20\"]"}),
                    Contains("variant.rigid.of: there is no case 'flexoin-20'") &&
                        Contains("did you mean 'flexion-20'?"));
  CHECK_THROWS_WITH(built_in({"variant.rigid.equivalent_neck=true"}),
                    Contains("equivalent_neck: unknown"));
  CHECK_THROWS_WITH(built_in({"pendulum.pulse=flection"}),
                    Contains("there is no pulse 'flection' (did you mean 'flexion'?)"));
  CHECK_THROWS_WITH(built_in({"pendulum.puls=flexion"}), Contains("pendulum.puls: unknown key"));
  CHECK_THROWS_WITH(built_in({"case.flexion-40.drop_angle=40 in"}),
                    Contains("case.flexion-40.drop_angle"));
  CHECK_THROWS_WITH(built_in({"pulse.flexion.times=[\"0 ms\", \"4 ms\", \"4 ms\", \"20 ms\", "
                              "\"30 ms\", \"36 ms\", \"42 ms\"]"}),
                    Contains("pulse.flexion.times") && Contains("must increase strictly"));
  CHECK_THROWS_WITH(
      built_in({"pulse.flexion.deceleration=[\"0 kg\", \"1 kg\", \"1 kg\", \"1 kg\", \"1 kg\", "
                "\"1 kg\", \"0 kg\"]"}),
      Contains("pulse.flexion.deceleration"));
}

TEST_CASE("what cannot be is refused before anything is computed") {
  CHECK_THROWS_WITH(built_in({"geometry.plate_thickness=-0.1 in"}), Contains("plate_thickness"));
  CHECK_THROWS_WITH(built_in({"geometry.plate_diametre=3 in"}),
                    Contains("unknown key (did you mean 'plate_diameter'?)"));
  CHECK_THROWS_WITH(built_in({"geometri.length=3 in"}), Contains("geometri: unknown key"));
  CHECK_THROWS_WITH(built_in({"case.flexion-20.kind=pendulm"}),
                    Contains("did you mean 'pendulum'?"));
  CHECK_THROWS_WITH(built_in({"case.flexion-20.bodies=[\"arm\", \"nek\"]"}),
                    Contains("there is no body 'nek' (did you mean 'neck'?)"));
  CHECK_THROWS_WITH(built_in({"case.flexion-20.impact_velocity=-1 m/s"}), Contains("positive"));
  CHECK_THROWS_WITH(built_in({"modes.attached_body=neck"}), Contains("expected a rigid body"));
  CHECK_THROWS_WITH(built_in({"modes.basis=residul"}), Contains("did you mean 'residual'?"));
  CHECK_THROWS_WITH(built_in({"modes.stress_stiffening=yes"}), Contains("unit-loads"));
  CHECK_THROWS_WITH(built_in({"solver.relative_tolerance=0"}), Contains("positive"));
}

namespace {

std::string refusal_of_study(const TemporaryFolder& folder, const std::string& text) {
  std::ofstream(folder / "mine.toml") << text;
  try {
    read_study(folder / "mine.toml", {});
  } catch (const InputError& error) {
    return error.what();
  }
  return "nothing was refused";
}

}  // namespace

TEST_CASE("a key that is not known where it stands is told where it belongs") {
  const TemporaryFolder folder;
  const auto told = [&](const std::string& text) { return refusal_of_study(folder, text); };
  const std::string file = "[geometry]\nfile = \"bar.msh\"\n";
  for (const std::string key : {"mesh = \"bar.inp\"", "step = \"bar.step\"", "path = \"a.msh\"",
                                "mesh_file = \"bar.bdf\"", "input = \"bar.unv\""}) {
    CHECK_THAT(told("[geometry]\n" + key + "\n"),
               Contains("mine.toml:2:") && Contains(": unknown key; is 'script' (gmsh script") &&
                   Contains(" or 'file' (Instead of a script: a file with a mesh"));
  }
  CHECK_THAT(told(file + "count = 5\n"),
             Contains("geometry.count: unknown key; it belongs in [modes]"));
  CHECK_THAT(told(file + "element = \"hex8\"\n"), Contains("it belongs in [mesh]"));
  CHECK_THAT(told(file + "youngs_modulus = \"1 GPa\"\n"),
             Contains("it belongs in [geometry.materials.<name>]"));
  CHECK_THAT(told(file + "[geometry.mesh]\nsize = \"1 mm\"\n"),
             Contains("geometry.mesh: unknown key; it belongs in the top level"));
  CHECK_THAT(told(file + "[output]\nmax_step = \"1 ms\"\n"), Contains("it belongs in [solver]"));
  CHECK_THAT(told(file + "[modes]\ndamping_ratio = 0.1\n"), Contains("it belongs in [[body]]"));
  CHECK_THAT(told(file + "[modes]\npulse_scaling = \"none\"\n"),
             Contains("it belongs in [pendulum], [static], [[case]] or [[variant]]"));
  CHECK_THAT(told(file + "[modes]\nname = \"a\"\n"), EndsWith("modes.name: unknown key"));
}

TEST_CASE("a key that another key's value leaves without effect is refused") {
  const TemporaryFolder folder;
  const std::string file = "[geometry]\nfile = \"bar.msh\"\n";
  const std::string matrices =
      "[matrices]\nstiffness = \"K.mtx\"\nmass = \"M.mtx\"\nnodes = \"x.txt\"\n";
  const std::pair<std::string, std::string> refused[] = {
      {file + "[solver]\nspectral_radius = 0.5\n",
       "solver.spectral_radius: has no effect without integrator"},
      {file + "[substructures]\nmodes = 3\n",
       "substructures.modes: has no effect without [[substructures.piece]]"},
      {file + "[substructures]\nnormal = [0, 0, 1]\n", "substructures.normal: has no effect"},
      {file + "[substructures]\nnormal = [0, 0, 1]\n[[substructures.piece]]\nname = \"a\"\nparts "
              "= [\"a\"]\n[[substructures.piece]]\nname = \"b\"\nparts = [\"b\"]\n",
       "substructures.normal: has no effect on substructures that are given by parts"},
      {file + "[modes]\nattached_to = \"tip\"\n",
       "modes.attached_to: has no effect without attached_body"},
      {file + "[modes]\nbasis_interfaces = [\"tip\"]\n",
       "modes.basis_interfaces: has no effect with basis = \"normal\""},
      {file + "[mesh]\nelement = \"hex8\"\n", "mesh.element: has no effect here (Element type of"},
      {"[geometry]\nfile = \"bar.step\"\ncoincident_nodes = \"keep\"\n",
       "geometry.coincident_nodes: has no effect on a shape file"},
      {"[geometry]\nscript = \"bar.geo\"\nslit_faces = [\"cut\"]\n",
       "geometry.slit_faces: has no effect with slits = \"none\""},
      {file +
           "[[load]]\nname = \"w\"\nkind = \"pressure\"\npressure = \"1 Pa\"\nmoment = [\"1 N m\", "
           "\"0 N m\", \"0 N m\"]\n",
       "load.w.moment: has no effect with kind = 'pressure' (Moment on a face set)"},
      {matrices + "[mesh]\nelement = \"hex8\"\n", "mesh: has no effect without [geometry]"},
      {matrices + "[substructures]\nmodes = 1\n", "substructures: has no effect with [matrices]"},
      {file +
           "[[load]]\nname = \"w\"\nkind = \"face\"\nmoment = [\"1 N m\", \"0 N m\", \"0 N m\"]\n"
           "position = [\"1 m\", \"0 m\", \"0 m\"]\n",
       "load.w.position: has no effect without force"},
      {file + "[sweep]\nseed = 3\noutputs = [\"modes.mass\"]\n[[sweep.parameter]]\nkey = "
              "\"modes.count\"\nvalues = [1, 2]\n",
       "sweep.seed: has no effect on a grid or a list"},
      {file + "[[body]]\nname = \"b\"\nkind = \"prescribed\"\ndirection = [0, 1, "
              "0]\n[body.turn]\naxis "
              "= [0, 1, 0]\ninitial_rate = \"1 rad/s\"\n",
       "body.b.direction: has no effect on a body that only rotates"},
      {matrices + "[modes]\nfixed = [\"a\"]\n", "modes.fixed: has no effect with [matrices]"},
  };
  for (const auto& [text, why] : refused) {
    CAPTURE(text);
    CHECK_THAT(refusal_of_study(folder, text), Contains("mine.toml:") && Contains(why));
  }
  CHECK_THROWS_WITH(built_in({"solver.spectral_radius=0.5", "solver.integrator=dormand_prince"}),
                    Contains("spectral_radius: has no effect"));
  CHECK_NOTHROW(built_in({"solver.spectral_radius=0.5", "solver.integrator=generalised_alpha"}));
}

TEST_CASE("values that later stages cannot take are refused at reading") {
  CHECK_THROWS_WITH(built_in({"body.neck.damping_ratio=-0.1"}),
                    Contains("damping_ratio: expected a value from 0 to 10, found -0.1"));
  CHECK_THROWS_WITH(built_in({"body.neck.damping_ratio=90"}), Contains("from 0 to 10, found 90"));
  CHECK_THROWS_WITH(built_in({"body.neck.damping_ratio=[0.1, -0.1]"}),
                    Contains("from 0 to 10, found -0.1"));
  CHECK_THROWS_WITH(built_in({"body.neck.correction_damping_ratio=-1"}), Contains("found -1"));
  CHECK_THROWS_WITH(built_in({"body.neck.damping_time=-1 ms"}), Contains("no negative value"));
  CHECK_THROWS_WITH(built_in({"solver.integrator=generalised_alpha", "solver.spectral_radius=1.5"}),
                    Contains("spectral_radius: expected a value from 0 to 1, found 1.5"));
  CHECK_THROWS_WITH(built_in({"geometry.materials.butyl.youngs_modulus=-1 MPa"}),
                    Contains("youngs_modulus: expected a positive value"));
  CHECK_THROWS_WITH(built_in({"geometry.materials.butyl.poissons_ratio=0.5"}),
                    Contains("poissons_ratio: expected a value between -1 and 0.5, found 0.5"));
  CHECK_THROWS_WITH(built_in({"body.head.mass=-1 kg"}),
                    Contains("body.head.name: body 'head': mass must be positive"));
  for (const std::string key :
       {"rigid_interfaces=[\"tpo\"]", "attached_to=tpo", "basis_interfaces=[\"tpo\"]"})
    CHECK_THROWS_WITH(
        built_in({"modes." + key, "modes.basis=residual"}),
        Contains("modes." + key.substr(0, key.find('=')) + ": there is no interface 'tpo'"));
}

TEST_CASE("supports, interfaces and parts of the neck are those that its study names") {
  const Study shipped = built_in();
  CHECK(shipped.modes.fixed == std::vector<std::string>{"bolts"});
  CHECK(shipped.modes.rigid_parts.size() == 5);
  REQUIRE(shipped.interfaces.size() == 2);
  CHECK(shipped.interfaces[0].name == "top");
  CHECK(shipped.interfaces[0].position_m.z() == shipped.neck()->dimensions.length);
  CHECK(shipped.interfaces[1].set == "bolts");

  const Study changed = built_in({"modes.fixed=[\"base\"]", "modes.attached_to=top",
                                  "interface.top.position=[\"0 in\", \"0 in\", \"6 in\"]"});
  CHECK(changed.modes.fixed == std::vector<std::string>{"base"});
  CHECK(changed.modes.attached_to == "top");
  CHECK(changed.neck()->fitted_to.empty());  // it was fitted with the head's original joint
}

TEST_CASE("a neck whose study does not say what it stands on is refused") {
  const TemporaryFolder folder;
  const std::filesystem::path mine = folder / "mine.toml";
  const auto write = [&](const std::string& modes) {
    std::ofstream file(mine);
    file << "[geometry]\nscript = \"neck.geo\"\n";
    for (const geometry::NeckDimension& dimension : geometry::neck_dimensions())
      file << dimension.name << " = \"" << built_in().neck()->dimensions.*dimension.member * 1e3
           << " mm\"\n";
    file << modes;
  };
  write("");
  CHECK_THROWS_WITH(read_study(mine, {}), Contains("modes.fixed: expected the node sets"));
  write("[modes]\nfixed = []\n");
  CHECK(read_study(mine, {}).modes.fixed.empty());
}

TEST_CASE("the basis is chosen by its name") {
  CHECK(built_in().modes.basis == fe_modal::BasisKind::normal);
  const Study study =
      built_in({"modes.basis=craig-bampton", "modes.basis_interfaces=[\"top\"]",
                "modes.stress_stiffening=unit-loads", "body.neck.correction_damping_ratio=0.3"});
  CHECK(study.modes.basis == fe_modal::BasisKind::craig_bampton);
  CHECK(study.modes.basis_interfaces == std::vector<std::string>{"top"});
  CHECK(study.modes.stress_stiffening);
  CHECK(study.model.of_structure.begin()->second.correction_damping_ratio == 0.3);
}

TEST_CASE("a study without geometry is a model and needs no geometry keys") {
  const TemporaryFolder folder;
  std::ofstream(folder / "model.toml") << "[[body]]\nname = \"ground\"\nkind = \"ground\"\n";
  const Study study = read_study(folder / "model.toml", {});
  CHECK_FALSE(study.structure);
  CHECK(study.model.model.bodies.size() == 1);
}
