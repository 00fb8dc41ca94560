// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

/// Plan of the system calls that fail, given by environment variables: FAULT_NOTE, a file of one
/// page of zeros for the record; FAULT_FOLDER, below which files count; FAULT_KIND, a name in
/// fault_plan.cpp; FAULT_AT, the number of the call of that kind, 0 for none; FAULT_ERROR, the
/// system's error number, 0 for a transfer of fewer bytes; FAULT_LASTS, 1 for all calls from there
/// on.
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

/// Starts the counting of allocations.
void begin_main();

/// Returns whether this call fails, with errno set; errno 0 stands for a transfer of fewer bytes.
bool fails(Kind kind, const char* path);
bool fails(Kind kind, int file);
bool memory_fails(std::size_t size);

}  // namespace fault
