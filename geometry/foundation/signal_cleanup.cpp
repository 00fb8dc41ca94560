// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/foundation/signal_cleanup.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <dirent.h>
#include <fcntl.h>
#include <string_view>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>

#include <climits>

#include "geometry/foundation/file_descriptor.h"

namespace flexneck {

namespace {

using Action = SignalCleanup::Action;

/// One registered cleanup. A handler may neither allocate nor lock, so their number is fixed.
struct Entry {
  std::atomic<bool> is_taken = false;
  std::atomic<bool> is_ready = false;
  pid_t owner = -1;  ///< a forked child does not clean up for its parent
  Action action = Action::remove_file;
  pid_t process = -1;
  std::array<char, PATH_MAX> path{};
};
std::array<Entry, 16> entries;

std::atomic<int> holds = 0;           ///< number of SignalHold objects
std::atomic<int> waiting_signal = 0;  ///< 0 if none waits

/// Registers a cleanup.
/// @param fill  sets the action
/// @return the number of the entry, -1 if none is free
template <typename Fill>
int add(const Fill& fill) {
  for (std::size_t k = 0; k < entries.size(); ++k) {
    if (entries[k].is_taken.exchange(true)) continue;
    entries[k].owner = ::getpid();
    fill(entries[k]);
    entries[k].is_ready = true;
    return static_cast<int>(k);
  }
  return -1;
}

// From here on only functions that a signal handler may call are used.

void remove_tree(int folder, const char* name);

/// @return true if the folder had entries
bool remove_entries(int folder) {
  constexpr std::size_t kNameStart = offsetof(dirent64, d_name);
  alignas(dirent64) std::array<char, 4096> block{};
  bool is_any = false;
  for (;;) {
    const long size = ::syscall(SYS_getdents64, folder, block.data(), block.size());
    if (size <= 0) return is_any;
    for (long place = 0; place < size;) {
      const char* const name = block.data() + place + kNameStart;
      unsigned short length = 0;
      std::memcpy(&length, block.data() + place + offsetof(dirent64, d_reclen), sizeof length);
      place += length;
      if (std::strcmp(name, ".") == 0 || std::strcmp(name, "..") == 0) continue;
      remove_tree(folder, name);
      is_any = true;
    }
  }
}

/// Removes a file, or a folder with its contents. No link is followed.
void remove_tree(int folder, const char* name) {
  if (::unlinkat(folder, name, 0) == 0 || errno != EISDIR) return;
  if (::unlinkat(folder, name, AT_REMOVEDIR) == 0) return;  // needs no free descriptor
  const int opened = ::openat(folder, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (opened < 0) return;
  // Reading a folder may skip entries while others are removed.
  for (int passes = 8; passes > 0 && remove_entries(opened); --passes) ::lseek(opened, 0, SEEK_SET);
  ::close(opened);
  ::unlinkat(folder, name, AT_REMOVEDIR);
}

void carry_out(const Entry& entry) {
  switch (entry.action) {
    case Action::end_process:
      ::kill(entry.process, SIGKILL);
      uninterrupted([&] { return ::waitpid(entry.process, nullptr, 0); });
      break;
    case Action::remove_folder:
      remove_tree(AT_FDCWD, entry.path.data());
      break;
    case Action::remove_file:
      ::unlink(entry.path.data());
      break;
    case Action::remove_empty_folder:
      ::rmdir(entry.path.data());
      break;
  }
}

extern "C" void end_by(int signal) {
  if (holds > 0 && (signal == SIGINT || signal == SIGTERM || signal == SIGHUP)) {
    waiting_signal = signal;
    // Another thread may have ended the last hold meanwhile: of the two, the one that takes the
    // signal back ends the process.
    if (holds > 0 || waiting_signal.exchange(0) == 0) return;
  }
  clean_up_now();
  std::signal(signal, SIG_DFL);
  std::raise(signal);  // delivered when the handler returns
}

}  // namespace

void clean_up_now() noexcept {
  for (const Action action : {Action::end_process, Action::remove_folder, Action::remove_file,
                              Action::remove_empty_folder}) {
    for (const Entry& entry : entries)
      if (entry.is_ready && entry.owner == ::getpid() && entry.action == action) carry_out(entry);
  }
}

void remove_folder(const std::filesystem::path& folder) noexcept {
  remove_tree(AT_FDCWD, folder.c_str());
}

void clean_up_on_signals() {
  struct sigaction action {};
  action.sa_handler = end_by;
  sigfillset(&action.sa_mask);
  // The first three ask for an end, the others report a crash.
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL}) {
    struct sigaction before {};
    if (::sigaction(signal, nullptr, &before) == 0 && before.sa_handler == SIG_DFL)
      ::sigaction(signal, &action, nullptr);
  }
}

SignalHold::SignalHold() noexcept { ++holds; }

SignalHold::~SignalHold() {
  if (--holds > 0) return;
  if (const int signal = waiting_signal.exchange(0); signal != 0) end_by(signal);
}

SignalCleanup::SignalCleanup(Action action, const std::filesystem::path& path) {
  const std::string_view text = path.native();
  if (text.size() >= PATH_MAX) return;
  entry_ = add([&](Entry& entry) {
    entry.action = action;
    *std::copy(text.begin(), text.end(), entry.path.begin()) = '\0';
  });
}

SignalCleanup::SignalCleanup(pid_t process)
    : entry_(add([&](Entry& entry) {
        entry.action = Action::end_process;
        entry.process = process;
      })) {}

SignalCleanup::SignalCleanup(SignalCleanup&& other) noexcept
    : entry_(std::exchange(other.entry_, -1)) {}

SignalCleanup& SignalCleanup::operator=(SignalCleanup&& other) noexcept {
  reset();
  entry_ = std::exchange(other.entry_, -1);
  return *this;
}

void SignalCleanup::reset() noexcept {
  if (entry_ < 0) return;
  Entry& entry = entries[static_cast<std::size_t>(std::exchange(entry_, -1))];
  entry.is_ready = false;
  entry.is_taken = false;
}

}  // namespace flexneck
