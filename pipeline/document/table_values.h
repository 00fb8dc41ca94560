// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "pipeline/document/study_document.h"

namespace flexneck::pipeline {

/// One of the texts in `names`, as its position. @throws InputError with the nearest name.
std::size_t choice(const StudyTable& table, const std::string& key,
                   const std::vector<std::string>& names);
/// The same; the first one where the key is not there.
std::size_t choice_or_first(const StudyTable& table, const std::string& key,
                            const std::vector<std::string>& names);
Eigen::Vector3d unit_vector(const StudyTable& table, const std::string& key);
/// Three quantities.
Eigen::Vector3d quantity_vector(const StudyTable& table, const std::string& key,
                                const std::string& si_unit);

}  // namespace flexneck::pipeline
