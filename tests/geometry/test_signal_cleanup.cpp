// SPDX-License-Identifier: GPL-3.0-or-later
#include <chrono>
#include <csignal>
#include <filesystem>
#include <functional>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>

#include "geometry/foundation/held_folder.h"
#include "geometry/foundation/output_file.h"
#include "geometry/foundation/signal_cleanup.h"
#include "geometry/foundation/temporary_folder.h"

using namespace flexneck;

namespace {

namespace fs = std::filesystem;
using Action = SignalCleanup::Action;

/// Ends a child process by a signal, in the middle of some work.
/// @return its status from waitpid
int status_after(int signal, const std::function<void()>& work) {
  const pid_t process = ::fork();
  if (process == 0) {
    std::signal(signal, SIG_DFL);  // Catch2 handles it
    clean_up_on_signals();
    work();
    ::kill(::getpid(), signal);
    ::sleep(10);  // the waiting thread ends the process
    ::_exit(0);
  }
  int status = 0;
  REQUIRE(::waitpid(process, &status, 0) == process);
  return status;
}

bool is_killed_by(int signal, int status) {
  return WIFSIGNALED(status) && WTERMSIG(status) == signal;
}

/// Fills a folder with folders and many entries.
void fill(const fs::path& folder) {
  fs::create_directories(folder / "some" / "more");
  for (int k = 0; k < 300; ++k) {
    write_text(folder / ("file with a long name, to fill a block soon " + std::to_string(k)), "x");
    write_text(folder / "some" / "more" / std::to_string(k), "x");
  }
}

}  // namespace

TEST_CASE("a signal takes with it what is temporary, and nothing else") {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const TemporaryFolder folder;
    fs::create_directory(folder / "kept");
    write_text(folder / "kept" / "file", "x");
    const int status = status_after(signal, [&] {
      fs::create_directory(folder / "full");
      fill(folder / "full");
      fs::create_symlink(folder / "kept", folder / "full" / "link");
      fs::create_directory(folder / "empty");
      write_text(folder / "file", "x");
      static const SignalCleanup full(Action::remove, folder / "full");
      static const SignalCleanup file(Action::remove, folder / "file");
      static const SignalCleanup empty(Action::remove_empty_folder, folder / "empty");
      static const SignalCleanup kept(Action::remove_empty_folder, folder / "kept");
      static SignalCleanup moved(Action::remove, folder / "kept" / "file");
      moved = SignalCleanup();
    });
    CHECK(is_killed_by(signal, status));
    CHECK(fs::exists(folder / "kept" / "file"));
    CHECK(std::distance(fs::directory_iterator(folder.path()), {}) == 1);
  }
}

TEST_CASE("a signal that comes between a file and the note of it takes the file along") {
  const TemporaryFolder folder;
  const int status = status_after(SIGTERM, [&] {
    const SignalHold outer;
    const SignalHold hold;
    ::kill(::getpid(), SIGINT);
    write_text(folder / "file", "x");
    static const SignalCleanup file(Action::remove, folder / "file");
  });
  CHECK(is_killed_by(SIGINT, status));
  CHECK(fs::is_empty(folder.path()));
}

TEST_CASE("a temporary folder and a file under way do not outlive a signal") {
  const TemporaryFolder folder;
  const std::string before = fs::temp_directory_path();
  ::setenv("TMPDIR", folder.path().c_str(), 1);
  const int status = status_after(SIGTERM, [&] {
    static const TemporaryFolder temporary;
    fill(temporary.path());
    static OutputFile file(folder / "result");
    file.write("x");
  });
  ::setenv("TMPDIR", before.c_str(), 1);
  CHECK(is_killed_by(SIGTERM, status));
  CHECK(fs::is_empty(folder.path()));
}

TEST_CASE("a child process ends before its files go") {
  std::array<int, 2> ends{};
  REQUIRE(::pipe(ends.data()) == 0);
  const int status = status_after(SIGTERM, [&] {
    const pid_t child = ::fork();
    if (child == 0) {
      for (;;) ::pause();
    }
    ::close(ends[1]);  // which the child holds open
    static const SignalCleanup cleanup(child);
  });
  ::close(ends[1]);
  char byte = 0;
  CHECK(is_killed_by(SIGTERM, status));
  CHECK(::read(ends[0], &byte, 1) == 0);  // it would wait for the child otherwise
  ::close(ends[0]);
}

TEST_CASE("a signal that is ignored stays so, and one with a handler only calls it") {
  static volatile std::sig_atomic_t calls = 0;
  const int status = status_after(SIGTERM, [] {
    std::signal(SIGHUP, SIG_IGN);
    clean_up_on_signals();
    std::signal(SIGINT, [](int) { calls = calls + 1; });
    ::kill(::getpid(), SIGHUP);
    ::kill(::getpid(), SIGINT);
    for (int k = 0; k < 1000 && calls == 0; ++k) ::usleep(1000);
    ::_exit(calls == 1 ? 7 : 1);
  });
  CHECK(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 7);
}

TEST_CASE("a folder that a killed process has left goes, those in use or new stay") {
  const TemporaryFolder folder;
  for (const char* const name : {"left-old", "left-held", "left-new", "other-old"}) {
    fs::create_directory(folder / name);
    write_text(folder / name / "file", "x");
  }
  for (const char* const name : {"left-old", "left-held", "other-old"})
    fs::last_write_time(folder / name, fs::file_time_type::clock::now() - std::chrono::hours(2));
  fs::create_directory_symlink(folder / "other-old", folder / "left-link");
  const FileDescriptor held = hold_folder(folder / "left-held");
  remove_abandoned(folder.path(), "left-");
  CHECK(!fs::exists(folder / "left-old"));
  CHECK(fs::exists(folder / "left-held" / "file"));
  CHECK(fs::exists(folder / "left-new" / "file"));
  CHECK(fs::exists(folder / "other-old" / "file"));
}
