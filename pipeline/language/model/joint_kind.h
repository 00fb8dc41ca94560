// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "multibody/joints/joint_kind.h"
#include "pipeline/language/document/study_document.h"

namespace flexneck::pipeline {

/// Names of all kinds, each alias behind the name that it stands for.
std::vector<std::string> names_of_kinds(std::span<const multibody::JointKind* const> kinds);

/// The kind of joint that the key `kind` names. @throws InputError with the nearest name.
const multibody::JointKind* joint_kind(const StudyTable& table,
                                       std::span<const multibody::JointKind* const> kinds);

}  // namespace flexneck::pipeline
