// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "fe_modal/exchange/reduced_body.h"

namespace flexneck::fe_modal {

/// Writes a body as Wallrapp's standard input data (SID_FEM), which Modelica's and other programs
/// read: its interfaces as nodes 1, 2, …, with their names in the first line. Taylor series in the
/// modal coordinates q: mdCM, J, Ct, Cr, Gr, Ge and Oe to the first order; no geometric stiffness,
/// no damping. SI units. guides/exchange.md describes the losses.
///
/// | block | coefficient | value |
/// |---|---|---|
/// | mdCM, Ct | m0; m1 | S1; S2, which Ct has too |
/// | J | m0; m1 of q_k | J0; G0_k + G0_k^T: xx, yy, zz, xy, xz, yz |
/// | Cr | m0(l, :); m1(l, k, :) | N0_l; N_kl |
/// | Gr | m0, three columns a mode; m1 of q_k | 2 G0_l; 2 G_kl |
/// | Ge | m0(l, three columns of mode k) | 2 N_kl |
/// | Oe | m0(l, :); m1(l, k, :) | -G0_l; -G_kl: xx, yy, zz, xy + yx, yz + zy, xz + zx |
///
/// @throws InputError if the file cannot be written.
void write_sid_fem(const std::filesystem::path& path, const ModalBody& body);

/// Reads such a file, of this or of another program.
/// @throws InputError with the line for data that is not supported, missing or in contradiction to
/// the rest.
ImportedModes read_sid_fem(const std::filesystem::path& path);

}  // namespace flexneck::fe_modal
