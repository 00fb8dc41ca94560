// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/cli/basis_text.h"

#include <algorithm>

#include <fmt/core.h>

#include "fe_modal/body/basis_table.h"
#include "fe_modal/body/mode_count_study.h"
#include "pipeline/process/text_table.h"

namespace flexneck::pipeline {

namespace {

using Rows = std::vector<std::vector<std::string>>;

/// Maximum number of frequencies of a loaded structure that are tabulated.
constexpr Eigen::Index kLoadedFrequencies = 3;

std::string cumulative_table(const fe_modal::ModalBody& body, const Eigen::MatrixXd& percent,
                             const std::vector<std::string>& columns) {
  Rows rows = {{"up to mode"}};
  rows.front().insert(rows.front().end(), columns.begin(), columns.end());
  for (Eigen::Index k = 0; k < percent.rows(); ++k) {
    std::vector<std::string> row = {body.modes[static_cast<std::size_t>(k)].name};
    for (const double share : percent.row(k)) row.push_back(fmt::format("{:.2f}", share));
    rows.push_back(std::move(row));
  }
  return text_table(rows);
}

/// Appends a cell such as "5.201 +4.4 %" for each frequency.
void add_compared(const Eigen::VectorXd& found, const Eigen::VectorXd& exact,
                  std::vector<std::string>& row) {
  for (Eigen::Index k = 0; k < std::min(kLoadedFrequencies, exact.size()); ++k) {
    row.push_back(k < found.size()
                      ? fmt::format("{:.3f} {:+.2f} %", found[k], 100 * (found[k] / exact[k] - 1))
                      : "");
  }
}

std::string mode_count_table(const fe_modal::ModalBody& body,
                             const fe_modal::AttachedFrequencies& attached) {
  Rows rows = {{"modes"}};
  for (const char* corrections : {"", ", + residual"}) {
    for (Eigen::Index k = 0; k < std::min(kLoadedFrequencies, attached.frequencies_Hz.size());
         ++k) {
      rows.front().push_back(fmt::format("{}. Hz{}", k + 1, corrections));
    }
  }
  for (const fe_modal::ModeCountRow& study : fe_modal::mode_count_study(body, attached)) {
    std::vector<std::string> row = {study.kept};
    add_compared(study.modes_only_Hz, attached.frequencies_Hz, row);
    add_compared(study.corrected_Hz, attached.frequencies_Hz, row);
    rows.push_back(std::move(row));
  }
  return rows.size() > 1 ? text_table(rows) : "";
}

}  // namespace

std::string loaded_text(const fe_modal::ModalBody& body, bool with_counts) {
  std::string text;
  for (const fe_modal::AttachedFrequencies& attached : body.attached) {
    text += "\n\nWith " + attached.body + " on " + attached.interface + ":";
    for (const double frequency : attached.frequencies_Hz)
      text += fmt::format(" {:.3f}", frequency);
    text += " Hz";
    const std::string study = with_counts ? mode_count_table(body, attached) : "";
    if (!study.empty())
      text += "\nFrequencies from the modes of the body, with their errors\n" + study;
  }
  return text;
}

std::string basis_text(const fe_modal::ModalBody& body) {
  const fe_modal::BasisTable table = fe_modal::basis_table(body);
  std::string text = "\nEffective mass and inertia about the origin, cumulative %\n" +
                     cumulative_table(body, table.inertia_percent,
                                      {"x", "y", "z", "about x", "about y", "about z"});
  for (const fe_modal::BasisTable::Captured& captured : table.compliance) {
    text += "\n\nStatic compliance at " + captured.interface + ", cumulative %\n" +
            cumulative_table(body, captured.percent,
                             {"ux/Fx", "uy/Fy", "uz/Fz", "rx/Mx", "ry/My", "rz/Mz"});
  }
  return text;
}

}  // namespace flexneck::pipeline
