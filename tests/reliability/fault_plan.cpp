// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/reliability/fault_plan.h"

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <execinfo.h>
#include <fcntl.h>
#include <string_view>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <climits>

namespace fault {

namespace {

constexpr std::array<std::string_view, kKinds> kNames = {
    "open",   "write", "pwrite", "read",   "pread",  "close",     "sync",     "truncate",
    "rename", "link",  "lock",   "folder", "memory", "memory512", "memory8k", "memory128k"};
constexpr std::array<std::size_t, 4> kMemoryBounds = {0, 512, 8192, 131072};

/// State shared with the runner and with the processes that this one starts; it persists however
/// the process ends.
struct Note {
  std::array<std::atomic<std::uint64_t>, kKinds> counts;
  std::atomic<std::uint64_t> reached;  ///< faults so far
  std::array<char, 2048> stack;        ///< stack of the last one: objects and offsets within them,
                                       ///< one per line
};

struct Plan {
  Note* note = nullptr;
  std::string_view folder;
  std::size_t kind = kKinds;
  std::uint64_t at = 0;
  int error = 0;
  bool lasts = false;
  std::atomic<bool> has_begun = false;
};
Plan plan;

std::string_view variable(const char* name) {
  const char* const value = std::getenv(name);
  return value == nullptr ? "" : value;
}

std::uint64_t number(const char* name) { return std::strtoull(variable(name).data(), nullptr, 10); }

/// Reads the plan before any other library of the program is set up.
__attribute__((constructor)) void read_plan() {
  const int file = static_cast<int>(
      syscall(SYS_openat, AT_FDCWD, variable("FAULT_NOTE").data(), O_RDWR | O_CLOEXEC));
  if (file < 0) return;
  void* const page = mmap(nullptr, sizeof(Note), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  syscall(SYS_close, file);
  if (page == MAP_FAILED) return;
  plan.folder = variable("FAULT_FOLDER");
  for (std::size_t kind = 0; kind < kKinds; ++kind)
    if (kNames[kind] == variable("FAULT_KIND")) plan.kind = kind;
  plan.at = number("FAULT_AT");
  plan.error = static_cast<int>(number("FAULT_ERROR"));
  plan.lasts = number("FAULT_LASTS") == 1;
  std::array<void*, 2> frames{};
  backtrace(frames.data(), frames.size());  // allocates memory the first time
  plan.note = static_cast<Note*>(page);
}

/// Notes the stack of the last fault: a library's handling of it is not the program's.
void note_stack() {
  std::array<void*, 24> frames{};
  const auto count = static_cast<std::size_t>(backtrace(frames.data(), frames.size()));
  char* place = plan.note->stack.data();
  const char* const end = place + plan.note->stack.size();
  for (std::size_t k = 2; k < count; ++k) {
    Dl_info object{};
    if (dladdr(frames[k], &object) == 0 || object.dli_fname == nullptr) continue;
    const char* const slash = std::strrchr(object.dli_fname, '/');
    const std::ptrdiff_t offset =
        static_cast<char*>(frames[k]) - static_cast<char*>(object.dli_fbase);
    const int length = std::snprintf(place, static_cast<std::size_t>(end - place), "%s %s %tx\n",
                                     slash == nullptr ? object.dli_fname : slash + 1,
                                     object.dli_sname == nullptr ? "-" : object.dli_sname, offset);
    if (length < 0 || length >= end - place) break;
    place += length;
  }
}

/// Counts a call.
/// @return true if it must fail
bool is_due(std::size_t kind) {
  const std::uint64_t before = plan.note->counts[kind].fetch_add(1);
  if (kind != plan.kind || plan.at == 0) return false;
  const bool is_it = before + 1 == plan.at || (plan.lasts && before >= plan.at);
  if (is_it) {
    ++plan.note->reached;
    note_stack();
  }
  return is_it;
}

/// False for a path of the system ("/proc/self/…") and for one elsewhere.
bool is_below_folder(const char* path) {
  if (path == nullptr) return false;
  std::array<char, PATH_MAX> current{};
  if (*path == '/') return std::string_view(path).starts_with(plan.folder);
  return syscall(SYS_getcwd, current.data(), current.size()) > 0 &&
         std::string_view(current.data()).starts_with(plan.folder);
}

bool is_below_folder(int file) {
  std::array<char, 40> name{};
  std::array<char, PATH_MAX> path{};
  std::snprintf(name.data(), name.size(), "/proc/self/fd/%d", file);
  return readlink(name.data(), path.data(), path.size() - 1) > 0 && path[0] == '/' &&
         is_below_folder(path.data());
}

template <typename File>
bool is_failing(Kind kind, File file) {
  const int before = errno;
  const bool is_it = plan.note != nullptr && is_below_folder(file) && is_due(kind);
  errno = is_it ? plan.error : before;
  return is_it;
}

}  // namespace

void begin_main() { plan.has_begun = plan.note != nullptr; }

bool fails(Kind kind, const char* path) { return is_failing(kind, path); }
bool fails(Kind kind, int file) { return is_failing(kind, file); }

bool memory_fails(std::size_t size) {
  if (!plan.has_begun) return false;
  bool is_it = false;
  for (std::size_t k = 0; k < kMemoryBounds.size(); ++k)
    if (size >= kMemoryBounds[k]) is_it = is_due(kMemory + k) || is_it;
  if (is_it) errno = ENOMEM;
  return is_it;
}

}  // namespace fault
