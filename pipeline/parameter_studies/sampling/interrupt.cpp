// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/parameter_studies/sampling/interrupt.h"

namespace flexneck::pipeline {

namespace {

// The only objects that the signal handler uses.
std::atomic<bool> asked = false;
struct sigaction usual {};
static_assert(std::atomic<bool>::is_always_lock_free);

void ask(int /*signal*/) {
  asked = true;
  ::sigaction(SIGINT, &usual, nullptr);
}

}  // namespace

Interrupt::Interrupt() {
  asked = false;
  ::sigaction(SIGINT, nullptr, &before_);
  if (before_.sa_handler == SIG_IGN) return;  // ignored, for instance in a background command
  usual = before_;
  struct sigaction action {};
  action.sa_handler = ask;
  action.sa_flags = SA_RESTART;
  ::sigaction(SIGINT, &action, nullptr);
}

Interrupt::~Interrupt() { ::sigaction(SIGINT, &before_, nullptr); }

const std::atomic<bool>& Interrupt::is_asked() { return asked; }

}  // namespace flexneck::pipeline
