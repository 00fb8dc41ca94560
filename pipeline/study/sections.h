// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "pipeline/study/study.h"
#include "pipeline/study/study_document.h"

namespace flexneck::pipeline {

GeometrySection read_geometry(const StudyTable& geometry, const StudyTable& mesh);
ModesSection read_modes(const StudyTable& modes);
BodySection read_body(const StudyTable& body);
MarkerSection read_marker(const StudyTable& marker);
JointSection read_joint(const StudyTable& joint);
ForceSection read_force(const StudyTable& force);
CaseSection read_case(const StudyTable& experiment);
void read_solver(const StudyTable& solver, Study& study);

/// One of the texts in `names`, as its position. @throws InputError with the nearest name.
std::size_t choice(const StudyTable& table, const std::string& key,
                   const std::vector<std::string>& names);
Eigen::Vector3d unit_vector(const StudyTable& table, const std::string& key);

}  // namespace flexneck::pipeline
