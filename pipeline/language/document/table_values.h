// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include <Eigen/Core>

#include "pipeline/language/document/study_document.h"

namespace flexneck::pipeline {

Eigen::Vector3d unit_vector(const StudyTable& table, const std::string& key);
/// Reads a vector of three quantities.
Eigen::Vector3d quantity_vector(const StudyTable& table, const std::string& key);

}  // namespace flexneck::pipeline
