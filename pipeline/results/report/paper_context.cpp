// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/results/report/paper_context.h"

#include "pipeline/language/document/study_document.h"

namespace flexneck::pipeline {

namespace {

constexpr Key kKeys[] = {
    Key::texts("remarks", kRequired, "Remarks on the paper that the report shows"),
};

}  // namespace

std::span<const Key> context_keys() { return kKeys; }

std::vector<std::string> read_paper_remarks(const std::filesystem::path& path) {
  const StudyDocument document(path, {}, kKeys);
  const StudyTable table = document.root();
  std::vector<std::string> remarks = table.texts("remarks");
  table.finish();
  return remarks;
}

}  // namespace flexneck::pipeline
