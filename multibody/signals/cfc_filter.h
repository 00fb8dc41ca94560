// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include <Eigen/Core>

namespace flexneck::multibody {

/// Channel frequency classes of SAE J211-1 and ISO 6487.
enum class ChannelClass { cfc60 = 60, cfc180 = 180, cfc600 = 600, cfc1000 = 1000 };

/// Name such as "CFC 600".
std::string name_of(ChannelClass channel_class);

/// The digital filter of SAE J211-1 annex C: a two-pole Butterworth filter run forwards and then
/// backwards, so that it has four poles and no phase shift. The gain at a frequency f is
///   1 / (1 + (tan(pi f T) / tan(pi 2.0775 CFC T))^4),   T the interval between samples:
/// one half at 2.0775 CFC. Beyond its ends the signal is continued by point reflection over ten
/// times the filter's time constant, at most over its own length.
/// @param interval_s  between samples; J211 wants at least ten samples per 1 / CFC
/// @param signal      at least two samples, of any unit
/// @throws InputError if the interval is not positive or too long, a sample is missing or not
/// finite.
Eigen::VectorXd cfc_filtered(const Eigen::VectorXd& signal, double interval_s, ChannelClass cfc);

}  // namespace flexneck::multibody
