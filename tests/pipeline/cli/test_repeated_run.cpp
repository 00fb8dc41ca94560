// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <filesystem>
#include <fstream>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/foundation/temporary_folder.h"
#include "tests/support/coarse_neck.h"
#include "tests/support/files.h"
#include "tests/support/flexneck_command.h"

using Catch::Matchers::Contains;
using namespace flexneck;
using testing::bytes_of;
using testing::check_refused;
using testing::CommandOutcome;
using testing::names_in;
using testing::run_flexneck;

namespace {

namespace fs = std::filesystem;

/// The coarsest neck and short runs: seconds instead of a minute.
const std::string kCoarse = std::string(testing::kCoarseNeck) + " --set pendulum.duration='0.2 s'";

}  // namespace

TEST_CASE("a run twice gives the same bytes, and knows the paper only in its verification") {
  const TemporaryFolder folder;
  const std::string first = (folder / "first").string();
  const std::string second = (folder / "second").string();
  const CommandOutcome outcome = run_flexneck("run -o " + first + kCoarse);
  INFO(outcome.text);
  REQUIRE((outcome.exit_code == 0 || outcome.exit_code == 1));  // coarse: may miss a frequency
  CHECK_THAT(outcome.text, Contains("bending 1") && Contains("torsion 2") && Contains("published"));
  std::vector<std::string> expected = {
      "mesh.h5",     "mesh.png",           "mesh.xdmf",         "mesh_view.h5",  "modes.h5",
      "modes.png",   "modes.xdmf",         "modes_view.h5",     "pendulum.json", "static.json",
      "timing.json", "pulse-spectrum.csv", "verification.json", "verdicts.json", "report.html",
      "figures",     "stages.json",        "study.json"};
  const auto add_case = [&](const std::string& name) {
    for (const char* const ending : {".csv", ".h5"}) expected.push_back(name + ending);
  };
  for (const char* const name : {"flexion", "extension", "lateral"})
    add_case("static-" + std::string(name));
  // There are 11 drops and their variants.
  std::vector<std::string> drops = {"lateral-65"};
  for (const char* const way : {"flexion-", "extension-"})
    for (const char* const angle : {"20", "40", "60", "80", "120"})
      drops.push_back(std::string(way) + angle);
  for (const std::string& drop : drops)
    for (const char* const variant : {"", "-rigid", "-equivalent"})
      add_case("pendulum-" + drop + variant);
  for (const char* const variant :
       {"flexion-20-duration", "flexion-40-duration", "extension-20-duration",
        "extension-40-duration", "flexion-20-spring", "flexion-60-spring", "flexion-120-spring",
        "lateral-65-spring", "flexion-20-rotating", "flexion-60-rotating", "flexion-120-rotating",
        "extension-120-part572", "extension-120-part572-rotating"})
    add_case("pendulum-" + std::string(variant));
  std::sort(expected.begin(), expected.end());
  CHECK(names_in(folder / "first") == expected);

  // Another table of published figures must change the verification and nothing else.
  std::ofstream(folder / "other.toml") << R"(
tolerance_percent = 1.0
bending = ["1 Hz", "2 Hz", "3 Hz", "4 Hz"]
torsion = ["5 Hz", "6 Hz"]
mode_order = ["axial"]
weight = "1 kg"
system_frequency = "1 Hz"
frequency_ratio = 1
effective_damping = 1
)";
  std::ofstream(folder / "other_study.toml")
      << "include = [\"" << FLEXNECK_SOURCE_DIR << "/pipeline/data/studies/hybrid3.toml\"]\n"
      << "[output]\nverification = \"other.toml\"\n";
  const CommandOutcome again =
      run_flexneck("run " + (folder / "other_study.toml").string() + " -o " + second + kCoarse);
  CHECK(again.exit_code == 1);
  const auto json_of = [&](const std::string& name) {
    return nlohmann::json::parse(bytes_of(folder / (name + "/verification.json")));
  };
  CHECK_FALSE(json_of("second")["passed"].get<bool>());
  // Verdicts of a regulation on the neck are results, and do not affect the exit code.
  CHECK_THAT(outcome.text, Contains("572.33 flexion") && Contains("572.33 extension"));
  const auto verdicts = nlohmann::json::parse(bytes_of(folder / "first/verdicts.json"));
  CHECK(verdicts["tables"][0]["name"] == "verdicts");
  CHECK(verdicts["tables"][0]["rows"].size() == 4);
  CHECK(verdicts["tables"][0]["rows"][0][3] == "FAIL");
  CHECK(verdicts["provenance"]["inputs"].dump().find("572.33.toml") != std::string::npos);
  // The figures are named as their file says.
  CHECK_THAT(again.text, Contains("Verification against synthetic figures"));
  CHECK_THAT(outcome.text, Contains("Verification against published figures"));
  CHECK(json_of("first")["rows"][0]["value"] == json_of("second")["rows"][0]["value"]);

  // The provenance names the study file, so compare the computed results.
  const CommandOutcome third = run_flexneck("run --force -o " + second + kCoarse);
  CHECK(third.text.substr(0, third.text.find(second)) ==
        outcome.text.substr(0, outcome.text.find(first)));
  for (const std::string& name : expected) {
    // Measured times, and files that show them.
    if (name == "timing.json" || name == "report.html" || name == "stages.json") continue;
    INFO(name);
    if (fs::is_directory(folder / ("first/" + name))) {
      CHECK(names_in(folder / ("first/" + name)) == names_in(folder / ("second/" + name)));
      continue;
    }
    CHECK(bytes_of(folder / ("first/" + name)) == bytes_of(folder / ("second/" + name)));
  }

  // Unchanged stages are kept, and their tables are shown again.
  const CommandOutcome kept = run_flexneck("run -o " + second + kCoarse);
  CHECK(kept.exit_code == outcome.exit_code);
  CHECK_THAT(kept.text,
             Contains("Inputs unchanged for report: results kept") && !Contains("Meshing") &&
                 Contains("Inputs unchanged for 46 of 46 pendulum cases: results kept") &&
                 Contains("Head/neck pendulum") && Contains("torsion 2"));
  const CommandOutcome touched =
      run_flexneck("run -o " + second + kCoarse + " --set case.flexion-60.duration='0.9 s'");
  // The case and its four variants are affected.
  CHECK_THAT(touched.text,
             Contains("Inputs unchanged for modes: results kept") &&
                 Contains("Inputs unchanged for static: results kept") &&
                 Contains("Inputs unchanged for 41 of 46 pendulum cases: results kept") &&
                 Contains("Head/neck pendulum: flexion-60\n") &&
                 Contains("Head/neck pendulum: flexion-60-rigid\n") &&
                 !Contains("Head/neck pendulum: flexion-40") &&
                 !Contains("Inputs unchanged for verify") && Contains("Writing the report"));
  CHECK(bytes_of(folder / "first/modes.h5") == bytes_of(folder / "second/modes.h5"));

  // Compared side by side the runs differ in that value and in no other setting.
  const std::string both = (folder / "both").string();
  const CommandOutcome compared = run_flexneck("compare " + first + " " + second + " -o " + both);
  CHECK(compared.exit_code == 0);
  CHECK_THAT(compared.text,
             Contains("case.flexion-60.duration") && Contains("0.9 s") && !Contains("geometry."));
  const auto tables = nlohmann::json::parse(bytes_of(folder / "both/comparison.json"))["tables"];
  CHECK(tables[0]["rows"].size() == 1);
  CHECK(fs::exists(folder / "both/comparison.html"));
  check_refused(run_flexneck("compare " + first), "at least two folders");
  check_refused(run_flexneck("compare " + first + " " + both + "/none"), "no such folder");
}
