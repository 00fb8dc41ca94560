// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/language/model/modes_use.h"

#include <numbers>
#include <utility>

#include "fe_modal/body/basis_kind.h"
#include "fe_modal/body/gap_coordinates.h"
#include "geometry/foundation/error.h"
#include "pipeline/language/model/model_sections.h"

namespace flexneck::pipeline {

namespace {

/// Range far above that of any body, so that a percentage is refused.
constexpr KeyDetails kRatio = {.range = {.low = 0, .high = 10}};

// Correction modes represent the static response of many higher modes; their own damping serves
// only to let their ringing decay. On the neck with the head (four normal, six residual modes) 0
// and 0.05 give the same system damping within 0.3 %, the modes' 0.9 raises it by 4 %; the rate 2
// zeta omega stays far from the explicit step's limit.
constexpr Key kKeys[] = {
    Key::texts("modes", kNone, "Names of the modes that are used (default: all)"),
    Key::one_or_numbers("damping_ratio", kNone, "Damping ratio: one for all modes, or one per mode",
                        kRatio),
    Key::number("correction_damping_ratio", "0.05",
                "With a single damping_ratio: damping ratio of the modes that only complete the "
                "static compliance, so that their vibrations die out",
                {.range = kRatio.range, .origin = Origin::inferred}),
    Key::quantity("damping_time", "s", kNone,
                  "Stiffness-proportional damping: this time multiplied by the stiffness, in "
                  "addition to or instead of damping_ratio",
                  {.range = at_least(0)}),
    Key::numbers("offset", kNone, "Modal coordinates of the permanent deformation, in kg^(1/2) m"),
    Key::numbers("modal_coordinates", kNone,
                 "Initial modal coordinates, in kg^(1/2) m (default: the offset)"),
    Key::numbers("modal_rates", kNone,
                 "Initial rates of the modal coordinates, in kg^(1/2) m/s (default: zero)"),
    Key::flag("stress_stiffening", "false", "Include the geometric stiffness of the body's loads"),
};

void require_size(const ModesUse& use, const std::string& key, std::size_t found,
                  Eigen::Index modes) {
  if (static_cast<Eigen::Index>(found) != modes)
    use.table.refuse(key, "expected a list of " + std::to_string(modes) + " entries");
}

Eigen::VectorXd vector_of(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

/// Damping ratios: the given ones, one number for each mode or one for all, plus those of a damping
/// matrix that is the stiffness times damping_time_s.
Eigen::VectorXd damping_ratios(const ModesUse& use, const fe_modal::ModalBody& modes) {
  Eigen::VectorXd ratios = std::numbers::pi * use.damping_time_s * modes.frequencies_Hz;
  if (!use.damping_ratios.empty()) {
    require_size(use, "damping_ratio", use.damping_ratios.size(), modes.mode_count());
    return ratios + vector_of(use.damping_ratios);
  }
  if (!use.damping_ratio) return ratios;
  for (Eigen::Index k = 0; k < ratios.size(); ++k)
    ratios[k] += fe_modal::is_correction(modes.modes[static_cast<std::size_t>(k)].kind)
                     ? use.correction_damping_ratio
                     : *use.damping_ratio;
  return ratios;
}

/// Slits that open and close need gap coordinates, and the modes with all of them shut.
void use_gaps(const ModesUse& use, const fe_modal::ModalBody& all, const std::string& from,
              multibody::DeformableBody& body) {
  if (use.modes && *use.modes != std::vector<std::string>{"all"})
    use.table.refuse("modes", "expected all modes, since the slits of " + from + " open and close");
  if (use.stress_stiffening)
    use.table.refuse("stress_stiffening", "not supported with slits that open and close");
  try {
    fe_modal::GapBody gaps = fe_modal::with_gap_coordinates(all);
    body.modes = std::move(gaps.modes);
    body.gaps = {std::move(gaps.stiffness), std::move(gaps.coupling)};
  } catch (const InputError& error) {
    throw InputError(from + ": " + error.what());
  }
}

}  // namespace

std::span<const Key> modes_use_keys() { return kKeys; }

ModesUse read_modes_use(const StudyTable& body) {
  ModesUse use(body);
  if (body.has("modes")) use.modes = body.texts("modes");
  const bool has_time = body.has("damping_time");
  if (has_time) use.damping_time_s = body.quantity("damping_time");
  if (body.has("damping_ratio") && body.is_list("damping_ratio")) {
    use.damping_ratios = body.numbers("damping_ratio");
  } else if (body.has("damping_ratio") || !has_time) {
    use.damping_ratio = body.number("damping_ratio");
    use.correction_damping_ratio = body.number("correction_damping_ratio");
  }
  if (body.has("offset")) use.offset = body.numbers("offset");
  if (body.has("modal_coordinates")) use.initial_modal = body.numbers("modal_coordinates");
  if (body.has("modal_rates")) use.initial_modal_rate = body.numbers("modal_rates");
  use.stress_stiffening = body.flag("stress_stiffening");
  return use;
}

multibody::DeformableBody use_modes(const ModesUse& use, const fe_modal::ModalBody& all,
                                    const std::string& from) {
  multibody::DeformableBody body;
  if (!all.slits.empty()) {
    use_gaps(use, all, from, body);
  } else {
    body.modes = use.modes ? at_key(use.table, "modes",
                                    [&] { return fe_modal::select_modes(all, *use.modes); })
                           : all;
  }
  body.damping_ratio = damping_ratios(use, body.modes);
  const auto take = [&](const std::string& key, const std::vector<double>& values,
                        Eigen::VectorXd& into) {
    if (values.empty()) return;
    require_size(use, key, values.size(), body.modes.mode_count());
    into = vector_of(values);
  };
  take("offset", use.offset, body.offset);
  take("modal_coordinates", use.initial_modal, body.initial_modal);
  take("modal_rates", use.initial_modal_rate, body.initial_modal_rate);
  body.stress_stiffening = use.stress_stiffening;
  if (body.stress_stiffening && !body.modes.geometric_stiffness)
    use.table.refuse("stress_stiffening",
                     from +
                         " has no geometric stiffness of the modes; make it again with "
                         "stress_stiffening = \"unit-loads\" in the [modes] of its study");
  return body;
}

}  // namespace flexneck::pipeline
