// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <csignal>

namespace flexneck::pipeline {

/// During its lifetime, the first Ctrl-C requests a stop instead of ending the process; the second
/// one ends it as usual. At most one object at a time.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  static const std::atomic<bool>& is_asked();

 private:
  struct sigaction before_ {};
};

}  // namespace flexneck::pipeline
