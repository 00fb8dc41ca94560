#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs what is missing, builds with warnings as errors, checks the form of the code and runs all
# tests. CI runs this and nothing else.
set -eu

root=$(cd "$(dirname "$0")/.." && pwd)
cd "$root"
sh cmake/setup.sh test

echo '== format'
git ls-files '*.cpp' '*.h' | xargs clang-format --dry-run --Werror

echo '== build'
cmake --preset ci -DFLEXNECK_TESTS=ON >/dev/null
cmake --build --preset ci

echo '== clang-tidy on what the last commit changed'
changed=$(git diff --name-only --diff-filter=d HEAD~1 -- '*.cpp' 2>/dev/null || true)
if [ -n "$changed" ]; then
  echo "$changed" | xargs -n 1 -P "$(nproc)" clang-tidy -p build --quiet
fi

echo '== tests'
export OMP_NUM_THREADS=1
ctest --preset ci --parallel "$(nproc)"
