// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/cli/child_tasks.h"

#include "pipeline/process/result_files.h"

namespace flexneck::pipeline {

const std::vector<ChildTask>& child_tasks() {
  static const std::vector<ChildTask> list = {{"copy", copy_task}};
  return list;
}

}  // namespace flexneck::pipeline
