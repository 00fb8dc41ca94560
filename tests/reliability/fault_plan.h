// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

/// Which calls of the system fail, as told by variables: FAULT_NOTE, a file of one page of zeros
/// for what happens; FAULT_FOLDER, below which files count; FAULT_KIND, a name of fault_plan.cpp;
/// FAULT_AT, which call of that kind, 0 for none; FAULT_ERROR, the number of the system's error, 0
/// for a transfer of fewer bytes; FAULT_LASTS, 1 for all calls from there on.
namespace fault {

enum Kind : std::uint8_t {
  kOpen,
  kWrite,
  kPwrite,
  kRead,
  kPread,
  kClose,
  kSync,
  kTruncate,
  kRename,
  kLink,
  kLock,
  kFolder,
  kMemory,
  kMemory512,
  kMemory8k,
  kMemory128k,
  kKinds
};

/// Counts memory from here on.
void begin_main();

/// Whether this call fails, with errno set; 0 there for a transfer of fewer bytes.
bool fails(Kind kind, const char* path);
bool fails(Kind kind, int file);
bool memory_fails(std::size_t size);

}  // namespace fault
