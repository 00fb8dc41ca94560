// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/results/report/report.h"

#include <array>

#include <nlohmann/json.hpp>

#include "geometry/foundation/output_file.h"
#include "pipeline/results/plotting/embedding.h"
#include "pipeline/results/report/curves.h"
#include "pipeline/results/report/figures/figures.h"
#include "pipeline/results/report/neck_scene.h"
#include "pipeline/results/report/page_sections.h"
#include "pipeline/results/report/paper_context.h"
#include "pipeline/results/report/pictures_html.h"
#include "pipeline/results/report/web_library.h"

namespace flexneck::pipeline {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

/// A section of the page.
struct PageSection {
  const char* id;
  const char* link;  ///< text of the link in the navigation
  const char* title;
  const char* content;  ///< name of its content
};
constexpr std::array<PageSection, 14> kSections = {
    {{"view", "Overview", "Overview", "overview"},
     {"warnings", "Warnings", kWarningsTitle, "warnings"},
     {"certification", "Certification", "Certification tests", "certification"},
     {"verification", "Verification", "Verification", "verification"},
     {"curves", "Curves", "Curves", "plots"},
     {"results", "Results", "Results of the experiments", "tables"},
     {"sweep", "Parameters varied", "Parameters varied", "sweep"},
     {"fit", "Fit", "Parameters fitted to targets", "fit"},
     {"figures", "Figures", "The paper's figures", "figures"},
     {"modes", "Modes", "Modes and their checks", "modes"},
     {"sensitivities", "Sensitivities", "Sensitivities to the inputs", "sensitivities"},
     {"remarks", "The paper", "Contradictions and gaps in the paper", "remarks"},
     {"inputs", "Inputs", "Inputs and their origin", "parameters"},
     {"provenance", "Provenance", "Provenance", "provenance"}}};

void add_sections(std::map<std::string, std::string>& texts) {
  for (const PageSection& section : kSections)
    add_section(section.id, section.link, section.title, texts.at(section.content), texts);
}

std::vector<std::string> paper_remarks(const Study& study) {
  if (study.verification.empty()) return {};
  fs::path path = study.verification;
  path.replace_filename(path.stem().string() + "_context.toml");
  return fs::exists(path) ? read_paper_remarks(path) : std::vector<std::string>();
}

}  // namespace

void write_report(const fs::path& path, const Results& results, const Study& study) {
  const Json scene = scene_of(results, study);
  const Json curves = curves_of(results, study);
  std::map<std::string, std::string> texts = page_sections(results, study, paper_remarks(study));
  const std::vector<DrawnFigure> figures =
      draw_figures(results, study, path.parent_path() / "figures");
  texts["figures"] = figures_html(figures);
  texts["sensitivities"] = tornado_html(figures) + texts["sensitivities"];
  texts["sweep"] = sweep_pictures_html(path.parent_path());
  texts["fit"] = fit_pictures_html(path.parent_path());
  texts["units"] = page_part("units.html");
  texts["head"] = page_head(texts["study"]);
  texts["overview"] = filled(
      page_part("overview.html"),
      {{"summary", texts["summary"]}, {"scene", scene.is_null() ? "" : page_part("scene.html")}});
  texts["plots"] = curves.is_null() ? "" : page_part("plots.html");
  add_sections(texts);
  Json scenes = Json::array();
  if (!scene.is_null()) scenes.push_back({{"label", ""}, {"scene", scene}});
  texts["data"] = page_data(scenes, curves);
  texts["scripts"] = page_scripts(!scene.is_null(), !curves.is_null());
  write_text(path, filled(page_part("report.html"), texts), Durability::none);
}

}  // namespace flexneck::pipeline
