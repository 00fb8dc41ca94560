// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "fe_modal/body/modal_body.h"
#include "geometry/foundation/hdf5_file.h"
#include "geometry/foundation/provenance.h"

namespace flexneck::fe_modal {

/// File format; its layout is described in pipeline/manual/reference/modes_file.md.
inline constexpr FileFormat kModalBodyFormat{"flexneck modal body", 2, "flexneck modes"};

struct ModalBodyFile {
  ModalBody body;
  Provenance provenance;
};

void write_modal_body(const std::filesystem::path& path, const ModalBodyFile& file);
/// @throws InputError if the file is missing, truncated, foreign, inconsistent in its shapes, or
/// breaks an identity that holds in every modal body (modal_body_check.h).
ModalBodyFile read_modal_body(const std::filesystem::path& path);

}  // namespace flexneck::fe_modal
