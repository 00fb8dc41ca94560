// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "fe_modal/body/modal_body.h"
#include "geometry/foundation/provenance.h"
#include "multibody/analysis/linearisation.h"
#include "pipeline/experiments/pendulum.h"
#include "pipeline/experiments/verification/reference.h"
#include "pipeline/language/study/study.h"

namespace flexneck::pipeline {

/// A figure and its reference, usually a published one.
struct VerificationRow {
  /// `compared` means that there is no tolerance; `unjudged` that there is one, but the table is
  /// not judged.
  enum class Status { passed, failed, compared, unjudged };
  std::string quantity;  ///< "bending 1", "weight", …
  std::string detail;    ///< name of the mode, or the method
  std::string unit;      ///< of value and reference: "Hz", "lb", "1", or empty for texts
  std::string value;     ///< value as printed
  std::string reference;
  std::optional<double> error_percent;
  Status status = Status::compared;
  bool fitted = false;  ///< the geometry was fitted to this figure
};

struct VerificationTable {
  std::vector<VerificationRow> rows;
  std::string reference_origins = "published";
  /// True unless a row has failed.
  bool passed() const;
};

/// Results of the pendulum for one case, as far as it was run.
struct PendulumEvidence {
  std::string case_name;
  std::string plane;  ///< "fore-aft" or "lateral"; all cases of a plane have the same small motions
  multibody::SystemMode with_gravity, without_gravity;
  std::optional<PendulumResult> run;
};

// Names of rows, which are also the targets' names in a neck's `fitted_to`.
inline constexpr const char* kWeightRow = "weight";
inline constexpr const char* kSystemFrequencyRow = "system frequency";

/// Reason why published frequencies do not judge a study's structure: a dimension or a material is
/// the user's own, or a fit made the neck and none of the frequencies is its target. Empty if they
/// do.
/// @param table  result of verify()
std::string why_unjudged(const Study& study, const VerificationTable& table);

/// Compares the results with references. The six frequencies, paired by kind and rank, pass or
/// fail; other figures are shown without a verdict. If why_unjudged() has a reason, a neck is
/// compared with published figures but not judged.
VerificationTable verify(const Study& study, const fe_modal::ModalBody& body,
                         const std::vector<PendulumEvidence>& pendulum, const Reference& reference);

std::string printed(const VerificationTable& table);

/// The table with its provenance, without the parameters.
struct VerificationFile {
  VerificationTable table;
  Provenance provenance;
};

/// Reads a table. @throws InputError if the file is missing or not one of flexneck.
VerificationFile read_verification(const std::filesystem::path& path);

/// Writes JSON, under a temporary name that is then renamed.
void write_verification(const std::filesystem::path& path, const VerificationTable& table,
                        const Provenance& provenance);

}  // namespace flexneck::pipeline
