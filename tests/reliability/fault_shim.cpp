// SPDX-License-Identifier: GPL-3.0-or-later
// Intercepts calls of the C library in a program (LD_PRELOAD) and makes some of them fail.
#include <cerrno>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

#include "tests/reliability/fault_plan.h"

using namespace fault;

// Functions of the C library under other names.
extern "C" {
void* libc_malloc(std::size_t size) __asm__("__libc_malloc");
void* libc_calloc(std::size_t count, std::size_t size) __asm__("__libc_calloc");
void* libc_realloc(void* block, std::size_t size) __asm__("__libc_realloc");
void* libc_memalign(std::size_t alignment, std::size_t size) __asm__("__libc_memalign");
using Main = int (*)(int, char**, char**);
int libc_start_main(Main main, int argc, char** argv, void (*init)(), void (*finish)(),
                    void (*finish_loader)(), void* stack_end) __asm__("__libc_start_main");
}

namespace {

/// @param transfer  takes the number of bytes
template <typename Transfer>
ssize_t transferred(Kind kind, int file, std::size_t size, const Transfer& transfer) {
  if (!fails(kind, file)) return transfer(size);
  return errno == 0 ? transfer(size > 1 ? size / 2 : size) : -1;
}

Main program_main = nullptr;

int begin(int argc, char** argv, char** environment) {
  begin_main();
  return program_main(argc, argv, environment);
}

int open_at(int folder, const char* path, int flags, mode_t mode) {
  if (fails(kOpen, path)) return -1;
  return static_cast<int>(syscall(SYS_openat, folder, path, flags, mode));
}

template <typename Function>
Function next(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

FILE* open_stream(const char* path, const char* mode) {
  static const auto original = next<FILE* (*)(const char*, const char*)>("fopen");
  return fails(kOpen, path) ? nullptr : original(path, mode);
}

}  // namespace

extern "C" {

int libc_start_main(Main main, int argc, char** argv, void (*init)(), void (*finish)(),
                    void (*finish_loader)(), void* stack_end) {
  program_main = main;
  static const auto original = next<decltype(&libc_start_main)>("__libc_start_main");
  return original(begin, argc, argv, init, finish, finish_loader, stack_end);
}

void* malloc(std::size_t size) { return memory_fails(size) ? nullptr : libc_malloc(size); }
void* calloc(std::size_t count, std::size_t size) {
  return memory_fails(count * size) ? nullptr : libc_calloc(count, size);
}
void* realloc(void* block, std::size_t size) {
  return memory_fails(size) ? nullptr : libc_realloc(block, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  return memory_fails(size) ? nullptr : libc_memalign(alignment, size);
}
int posix_memalign(void** block, std::size_t alignment, std::size_t size) {
  if (memory_fails(size)) return ENOMEM;
  *block = libc_memalign(alignment, size);
  return *block == nullptr ? ENOMEM : 0;
}

// If there is no mode argument, the value read for it is not used.
#define FLAGS_AND_MODE                                           \
  va_list rest;                                                  \
  va_start(rest, flags);                                         \
  const auto mode = static_cast<mode_t>(va_arg(rest, unsigned)); \
  va_end(rest)
int open(const char* path, int flags, ...) {
  FLAGS_AND_MODE;
  return open_at(AT_FDCWD, path, flags, mode);
}
int open64(const char* path, int flags, ...) {
  FLAGS_AND_MODE;
  return open_at(AT_FDCWD, path, flags, mode);
}
int openat(int folder, const char* path, int flags, ...) {
  FLAGS_AND_MODE;
  return open_at(folder, path, flags, mode);
}
FILE* fopen(const char* path, const char* mode) { return open_stream(path, mode); }
FILE* fopen64(const char* path, const char* mode) { return open_stream(path, mode); }

ssize_t write(int file, const void* bytes, std::size_t size) {
  return transferred(kWrite, file, size,
                     [&](std::size_t count) { return syscall(SYS_write, file, bytes, count); });
}
ssize_t writev(int file, const iovec* parts, int count) {
  if (fails(kWrite, file) && errno != 0) return -1;
  return syscall(SYS_writev, file, parts, count);
}
ssize_t pwrite(int file, const void* bytes, std::size_t size, off_t place) {
  return transferred(kPwrite, file, size, [&](std::size_t count) {
    return syscall(SYS_pwrite64, file, bytes, count, place);
  });
}
ssize_t read(int file, void* bytes, std::size_t size) {
  return transferred(kRead, file, size,
                     [&](std::size_t count) { return syscall(SYS_read, file, bytes, count); });
}
ssize_t pread(int file, void* bytes, std::size_t size, off_t place) {
  return transferred(kPread, file, size, [&](std::size_t count) {
    return syscall(SYS_pread64, file, bytes, count, place);
  });
}
/// Closes the descriptor even if an error is reported.
int close(int file) {
  const bool is_it = fails(kClose, file);
  const int error = errno;
  const long result = syscall(SYS_close, file);
  if (is_it) errno = error;
  return is_it ? -1 : static_cast<int>(result);
}
int fclose(FILE* file) {
  static const auto original = next<int (*)(FILE*)>("fclose");
  const bool is_it = fails(kClose, fileno(file));
  const int error = errno;
  const int result = original(file);
  if (is_it) errno = error;
  return is_it ? EOF : result;
}
int fsync(int file) { return fails(kSync, file) ? -1 : static_cast<int>(syscall(SYS_fsync, file)); }
int fdatasync(int file) {
  return fails(kSync, file) ? -1 : static_cast<int>(syscall(SYS_fdatasync, file));
}
int ftruncate(int file, off_t size) noexcept {
  return fails(kTruncate, file) ? -1 : static_cast<int>(syscall(SYS_ftruncate, file, size));
}
int rename(const char* from, const char* to) noexcept {
  return fails(kRename, to) ? -1 : static_cast<int>(syscall(SYS_rename, from, to));
}
int linkat(int from_folder, const char* from, int to_folder, const char* to, int flags) noexcept {
  if (fails(kLink, to)) return -1;
  return static_cast<int>(syscall(SYS_linkat, from_folder, from, to_folder, to, flags));
}
int flock(int file, int operation) noexcept {
  return fails(kLock, file) ? -1 : static_cast<int>(syscall(SYS_flock, file, operation));
}
int mkdir(const char* path, mode_t mode) noexcept {
  return fails(kFolder, path) ? -1 : static_cast<int>(syscall(SYS_mkdir, path, mode));
}

}  // extern "C"
