// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/foundation/available_memory.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <limits>
#include <sys/resource.h>
#include <unistd.h>

#include "geometry/foundation/output_file.h"

namespace flexneck {

namespace fs = std::filesystem;

namespace {

constexpr double kUnknown = std::numeric_limits<double>::infinity();

double number_at(const std::string& text, std::size_t place, double otherwise) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data() + place, text.data() + text.size(), number);
  return error == std::errc() ? number : otherwise;
}

/// The number that follows a word, as in "MemAvailable: 123 kB"; `otherwise` if there is none.
double number_behind(const fs::path& file, const std::string& word, double otherwise) {
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    if (!line.starts_with(word)) continue;
    const std::size_t digits = line.find_first_of("0123456789", word.size());
    if (digits != std::string::npos) return number_at(line, digits, otherwise);
  }
  return otherwise;
}

/// The number that a file holds; `otherwise` if it says "max" or is missing.
double number_in(const fs::path& file, double otherwise) {
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  return number_at(line, 0, otherwise);
}

/// Bytes that a control group (version 1 or 2) leaves, by its folder. Cached files count as free.
double left_in_group(const fs::path& group) {
  const double limit = number_in(group / "memory.max", kUnknown);
  const double old_limit = number_in(group / "memory.limit_in_bytes", kUnknown);
  const double used =
      number_in(group / "memory.current", number_in(group / "memory.usage_in_bytes", 0));
  const double cached = number_behind(group / "memory.stat", "total_inactive_file",
                                      number_behind(group / "memory.stat", "inactive_file", 0));
  return std::min(limit, old_limit) - std::max(used - cached, 0.0);
}

/// Bytes that the process's control groups leave. A line of /proc/self/cgroup reads "4:memory:/a/b"
/// or "0::/a/b"; the group's folder and all above it count.
double left_in_groups(const fs::path& root) {
  const fs::path all = root / "sys/fs/cgroup";
  double left = std::min(left_in_group(all), left_in_group(all / "memory"));
  std::ifstream stream(root / "proc/self/cgroup");
  for (std::string line; std::getline(stream, line);) {
    const std::size_t first = line.find(':');
    const std::size_t second = line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    if (!controllers.empty() && controllers.find("memory") == std::string::npos) continue;
    const fs::path top = controllers.empty() ? all : all / "memory";
    for (fs::path group = fs::path(line.substr(second + 1)).relative_path(); !group.empty();
         group = group.parent_path()) {
      left = std::min(left, left_in_group(top / group));
    }
  }
  return left;
}

double left_of_addresses(const fs::path& root) {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return kUnknown;
  const double pages = number_in(root / "proc/self/statm", 0);
  return static_cast<double>(limit.rlim_cur) - pages * static_cast<double>(sysconf(_SC_PAGESIZE));
}

}  // namespace

double available_memory(const fs::path& root) {
  constexpr double kKilobyte = 1024;  // the unit that the kernel calls kB
  const double of_machine =
      kKilobyte * number_behind(root / "proc/meminfo", "MemAvailable:", kUnknown);
  return std::max(std::min({of_machine, left_in_groups(root), left_of_addresses(root)}), 0.0);
}

std::string memory_text(double bytes) {
  constexpr double kGigabyte = 1e9;
  return rounded_text(bytes / kGigabyte, 3) + " GB";
}

double peak_memory() {
  constexpr double kKilobyte = 1024;
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return kKilobyte * static_cast<double>(usage.ru_maxrss);
}

OutOfMemory out_of_memory(const std::string& doing, const std::string& advice) {
  return OutOfMemory("out of memory while " + doing + ": " + memory_text(peak_memory()) +
                     " are used, " + memory_text(available_memory()) + " are free; " + advice);
}

void require_memory(const std::string& what, double bytes, const std::string& advice) {
  const double available = available_memory();
  if (bytes <= available) return;
  throw InputError(what + " needs about " + memory_text(bytes) + " of memory, but only " +
                   memory_text(available) + " are free; " + advice);
}

}  // namespace flexneck
