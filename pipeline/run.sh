#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs what is missing, builds, and runs a study: geometry, modes, motion, verification.
# Usage: sh pipeline/run.sh [what `flexneck run` takes]     (default: the built-in study, into out/)
set -eu

root=$(cd "$(dirname "$0")/.." && pwd)
sh "$root/cmake/setup.sh" build
if [ ! -f "$root/build/build.ninja" ]; then
  (cd "$root" && cmake --preset release -DFLEXNECK_TESTS=OFF) >/dev/null
fi
cmake --build "$root/build" --target product --parallel "$(nproc)"
exec "$root/build/flexneck" run "$@"
