// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace flexneck {

/// What of a file is on the disk, whatever happens to the machine, once it is in its place.
enum class Durability {
  content,  ///< all of it; its name, with the next sync_folder()
  none      ///< what can be made again from other files: the system writes it when it likes
};

}  // namespace flexneck
