// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/report/paper_context.h"

#include "pipeline/study/study_document.h"

namespace flexneck::pipeline {

namespace {

Corridor read_corridor(const StudyTable& table) {
  Corridor corridor;
  corridor.experiment = table.text("case");
  corridor.channel = table.text("channel");
  corridor.what = table.text("what");
  corridor.unit = table.text("unit");
  const std::vector<double> times_s = table.quantities("times", "s", 2);
  const std::vector<double> values = table.quantities("values", corridor.unit, 2);
  table.finish();
  corridor.from_s = times_s[0];
  corridor.to_s = times_s[1];
  corridor.low = values[0];
  corridor.high = values[1];
  return corridor;
}

}  // namespace

PaperContext read_context(const std::filesystem::path& path) {
  const StudyDocument document(path, {});
  const StudyTable table = document.root();
  PaperContext context;
  context.corridor_source = table.text("corridor_source");
  context.remarks = table.texts("remarks");
  for (const StudyTable& each : table.tables("corridor")) {
    context.corridors.push_back(read_corridor(each));
  }
  table.finish();
  return context;
}

}  // namespace flexneck::pipeline
