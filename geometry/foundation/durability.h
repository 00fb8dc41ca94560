// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace flexneck {

/// The part of a file that is safe on the disk, whatever happens to the machine, once the file is
/// in its place.
enum class Durability {
  content,  ///< its whole content; its name, with the next sync_folder()
  none  ///< nothing: it can be made again from other files, and the system writes it when it likes
};

}  // namespace flexneck
