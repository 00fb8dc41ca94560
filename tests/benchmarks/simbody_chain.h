// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace flexneck::benchmarks {

/// Times rigid_chain() in Simbody, by its Runge-Kutta-Merson method at four accuracies, and prints
/// the error of the head's centre after 1 s against its own run at 1e-12; prints "not run" in a
/// build without Simbody.
void report_simbody_chain(int runs);

}  // namespace flexneck::benchmarks
