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
#include "pipeline/study/study.h"
#include "pipeline/verification/reference.h"

namespace flexneck::pipeline {

/// One figure beside its reference, published as a rule.
struct VerificationRow {
  /// What is compared has no tolerance; what is unjudged has one, but the table is not judged.
  enum class Status { passed, failed, compared, unjudged };
  std::string quantity;  ///< "bending 1", "weight", …
  std::string detail;    ///< which mode, which method
  std::string unit;      ///< of value and reference: "Hz", "lb", "1", or empty for texts
  std::string value;     ///< as printed
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

/// What the pendulum says of one case, as far as it was run.
struct PendulumEvidence {
  std::string case_name;
  std::string plane;  ///< "fore-aft" or "lateral"; small motions are the same for all cases of it
  multibody::SystemMode with_gravity, without_gravity;
  std::optional<PendulumResult> run;
};

// What rows are called, which is how `fitted_to` of a neck names its targets, too.
inline constexpr const char* kWeightRow = "weight";
inline constexpr const char* kSystemFrequencyRow = "system frequency";

/// Why published frequencies do not judge a study's structure: a dimension or a material is the
/// user's own, or a fit made the neck and none of the frequencies is its target. Empty if they do.
/// @param table  of verify()
std::string why_unjudged(const Study& study, const VerificationTable& table);

/// The six frequencies, paired by kind and rank, pass or fail; the rest is shown beside. Against
/// published figures a neck is shown, not judged, where why_unjudged() has a reason.
VerificationTable verify(const Study& study, const fe_modal::ModalBody& body,
                         const std::vector<PendulumEvidence>& pendulum, const Reference& reference);

std::string printed(const VerificationTable& table);

/// The table with what it was made from, less its parameters.
struct VerificationFile {
  VerificationTable table;
  Provenance provenance;
};

/// @throws InputError if the file is missing or is none of ours.
VerificationFile read_verification(const std::filesystem::path& path);

/// JSON, under a temporary name that is renamed.
void write_verification(const std::filesystem::path& path, const VerificationTable& table,
                        const Provenance& provenance);

}  // namespace flexneck::pipeline
