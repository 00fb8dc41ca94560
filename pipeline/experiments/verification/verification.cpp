// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/experiments/verification/verification.h"

#include <algorithm>
#include <set>

#include <fmt/core.h>

#include "geometry/foundation/units.h"
#include "multibody/analysis/linearisation.h"
#include "pipeline/experiments/verification/mode_rank.h"
#include "pipeline/process/text_table.h"

namespace flexneck::pipeline {

namespace {

using Status = VerificationRow::Status;

bool is_fitted(const Study& study, const std::string& what) {
  if (study.neck() == nullptr) return false;
  const auto& fitted = study.neck()->fitted_to;
  return std::find(fitted.begin(), fitted.end(), what) != fitted.end();
}

double percent_off(double value, double reference) { return 100 * (value / reference - 1); }

/// True if the frequency is a target of the fit, which names all frequencies, or some by kind and
/// rank or by the mode.
bool is_fitted_frequency(const Study& study, const VerificationRow& row) {
  return is_fitted(study, "frequencies") || is_fitted(study, row.quantity) ||
         is_fitted(study, row.detail);
}

/// Adds the frequencies, not judged yet.
void add_frequencies(VerificationTable& table, const Study& study, const fe_modal::ModalBody& body,
                     const std::string& kind, const std::vector<double>& references_Hz) {
  const std::vector<std::size_t> modes = modes_of_kind(body, kind);
  for (std::size_t rank = 0; rank < references_Hz.size(); ++rank) {
    VerificationRow row;
    row.quantity = kind + " " + std::to_string(rank + 1);
    row.unit = "Hz";
    row.status = Status::unjudged;
    row.reference = fmt::format("{:.1f}", references_Hz[rank]);
    if (rank < modes.size()) {
      const double value = body.frequencies_Hz[static_cast<Eigen::Index>(modes[rank])];
      row.detail = body.modes[modes[rank]].name;
      row.value = fmt::format("{:.3f}", value);
      row.error_percent = percent_off(value, references_Hz[rank]);
    } else {
      row.detail = "not among the computed modes; increase modes.count";
    }
    row.fitted = is_fitted_frequency(study, row);
    table.rows.push_back(std::move(row));
  }
}

/// Judges the frequencies; one that was not found has failed.
void judge_frequencies(VerificationTable& table, double tolerance_percent) {
  for (VerificationRow& row : table.rows) {
    if (row.status != Status::unjudged) continue;
    const bool is_near = row.error_percent && std::abs(*row.error_percent) <= tolerance_percent;
    row.status = is_near ? Status::passed : Status::failed;
  }
}

/// Initials such as "b b t" for bending, bending, torsion.
std::string initials(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word.substr(0, 1);
  return text;
}

/// Adds the order of the modes, and the twist that the paper finds in the second.
void add_mode_character(VerificationTable& table, const fe_modal::ModalBody& body,
                        const Reference& reference) {
  std::vector<std::string> order;
  for (std::size_t k = 0; k < std::min(body.modes.size(), reference.mode_order.size()); ++k) {
    order.push_back(kind_of(body.modes[k]));
  }
  VerificationRow row;
  row.quantity = "mode order";
  row.detail = std::string("bending, torsion, axial: ") +
               (order == reference.mode_order ? "the same" : "differs");
  row.value = initials(order);
  row.reference = initials(reference.mode_order);
  table.rows.push_back(row);
  const std::vector<std::size_t> bending = modes_of_kind(body, "bending");
  for (std::size_t rank = 0; rank < std::min<std::size_t>(2, bending.size()); ++rank) {
    const fe_modal::ModeRecord& mode = body.modes[bending[rank]];
    VerificationRow twist;
    twist.quantity = "twist of bending " + std::to_string(rank + 1);
    twist.detail = mode.name;
    twist.unit = "%";
    twist.value = fmt::format("{:.2f}", mode.shares_percent[2]);
    twist.reference = rank == 1 ? "some" : "not reported";
    table.rows.push_back(twist);
  }
}

VerificationRow compared(const std::string& quantity, const std::string& detail,
                         const std::string& unit, double value, double reference, bool fitted) {
  VerificationRow row;
  row.quantity = quantity;
  row.detail = detail;
  row.unit = unit;
  row.value = fmt::format("{:.3f}", value);
  row.reference = fmt::format("{:g}", reference);
  row.error_percent = percent_off(value, reference);
  row.fitted = fitted;
  return row;
}

/// Text on how a small motion was found.
std::string eigenvalue_text(const std::string& plane, const multibody::SystemMode& mode,
                            const std::string& gravity) {
  return plane + ", eigenvalue, " + gravity +
         (mode.kink.empty() ? "" : ", of the mean stiffness at a kink");
}

/// Adds the small motions in a plane: system frequency, its ratio to the neck's, damping.
void add_small_motions(VerificationTable& table, const PendulumEvidence& evidence,
                       const fe_modal::ModalBody& body, const Reference& reference, bool fitted) {
  const multibody::SystemMode& mode = evidence.with_gravity;
  const multibody::SystemMode& weightless = evidence.without_gravity;
  const std::string how = eigenvalue_text(evidence.plane, mode, "gravity");
  table.rows.push_back(compared(kSystemFrequencyRow,
                                eigenvalue_text(evidence.plane, weightless, "no gravity"), "Hz",
                                weightless.frequency_Hz, reference.system_frequency_Hz, fitted));
  table.rows.push_back(compared(kSystemFrequencyRow, how, "Hz", mode.frequency_Hz,
                                reference.system_frequency_Hz, fitted));
  table.rows.push_back(compared("frequency ratio", how, "1",
                                body.frequencies_Hz[0] / mode.frequency_Hz,
                                reference.frequency_ratio, fitted));
  table.rows.push_back(compared("effective damping", how, "1", mode.damping_ratio,
                                reference.effective_damping, false));
}

/// Adds the free motion of a run after its pulse.
void add_run(VerificationTable& table, const PendulumEvidence& evidence,
             const Reference& reference) {
  if (!evidence.run) return;
  const PendulumResult& run = *evidence.run;
  if (run.run_frequency_Hz) {
    table.rows.push_back(compared(kSystemFrequencyRow, evidence.case_name + ", run", "Hz",
                                  *run.run_frequency_Hz, reference.system_frequency_Hz, false));
  }
  if (run.run_damping_ratio) {
    table.rows.push_back(compared("effective damping", evidence.case_name + ", run, peak to peak",
                                  "1", *run.run_damping_ratio, reference.effective_damping, false));
  }
}

void add_system(VerificationTable& table, const Study& study, const fe_modal::ModalBody& body,
                const std::vector<PendulumEvidence>& pendulum, const Reference& reference) {
  const bool fitted = is_fitted(study, kSystemFrequencyRow);
  for (const fe_modal::AttachedFrequencies& attached : body.attached) {
    table.rows.push_back(
        compared(kSystemFrequencyRow,
                 "finite elements, " + attached.body + " on " + attached.interface + ", no gravity",
                 "Hz", attached.frequencies_Hz[0], reference.system_frequency_Hz, fitted));
  }
  std::set<std::string> planes;
  for (const PendulumEvidence& evidence : pendulum) {
    // The fit used the fore-aft motion.
    if (planes.insert(evidence.plane).second) {
      add_small_motions(table, evidence, body, reference, fitted && evidence.plane == "fore-aft");
    }
  }
  for (const PendulumEvidence& evidence : pendulum) add_run(table, evidence, reference);
}

}  // namespace

bool VerificationTable::passed() const {
  return std::none_of(rows.begin(), rows.end(),
                      [](const VerificationRow& row) { return row.status == Status::failed; });
}

std::string why_unjudged(const Study& study, const VerificationTable& table) {
  const std::string own = own_value_of_geometry(study.parameters);
  if (!own.empty()) return own + " is a value of your own, not that of the published neck";
  const bool is_fit = study.neck() != nullptr && !study.neck()->fitted_values.empty();
  const bool has_target = std::ranges::any_of(table.rows, [](const VerificationRow& row) {
    return row.fitted && row.status != Status::compared;
  });
  return is_fit && !has_target ? "this neck was fitted, but not to these frequencies" : "";
}

VerificationTable verify(const Study& study, const fe_modal::ModalBody& body,
                         const std::vector<PendulumEvidence>& pendulum,
                         const Reference& reference) {
  VerificationTable table;
  table.reference_origins = reference.origins;
  add_frequencies(table, study, body, "bending", reference.bending_Hz);
  add_frequencies(table, study, body, "torsion", reference.torsion_Hz);
  if (reference.origins.find("published") == std::string::npos ||
      why_unjudged(study, table).empty())
    judge_frequencies(table, reference.tolerance_percent);
  add_mode_character(table, body, reference);
  const double pound = factor_from_si("kg", "lb");
  table.rows.push_back(compared(kWeightRow, "of the mesh", "lb", body.invariants.mass * pound,
                                reference.weight_kg * pound, is_fitted(study, kWeightRow)));
  add_system(table, study, body, pendulum, reference);
  return table;
}

std::string printed(const VerificationTable& table) {
  std::vector<std::vector<std::string>> rows = {
      {"quantity", "how", "computed", table.reference_origins, "unit", "error %", "", ""}};
  for (const VerificationRow& row : table.rows) {
    const char* const verdict = row.status == Status::passed   ? "pass"
                                : row.status == Status::failed ? "FAIL"
                                                               : "";
    rows.push_back({row.quantity, row.detail, row.value, row.reference, row.unit,
                    row.error_percent ? fmt::format("{:+.2f}", *row.error_percent) : "", verdict,
                    row.fitted ? "fitted" : ""});
  }
  return text_table(rows, {0, 1, 6, 7});
}

}  // namespace flexneck::pipeline
