#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs what is missing, builds with warnings as errors, checks the form of the code and runs all
# tests. CI runs this and nothing else.
set -eu

root=$(cd "$(dirname "$0")/.." && pwd)
cd "$root"
sh cmake/setup.sh test
cores=$(nproc)  # before OMP_NUM_THREADS is set, which nproc obeys

echo '== format'
git ls-files '*.cpp' '*.h' | xargs clang-format --dry-run --Werror

echo '== build'
cmake --preset ci -DFLEXNECK_TESTS=ON >/dev/null
cmake --build --preset ci --parallel "$cores"  # more at once slow each other down by a sixth

echo '== clang-tidy on what the last 20 commits changed, the latest 40 files'  # a file takes 15 s
cmake --preset tidy -DFLEXNECK_TESTS=ON >/dev/null
cmake --preset fuzz >/dev/null
tidy() { # FOLDER OF THE BUILD, pathspecs
  build=$1
  shift
  git log -20 --no-merges --diff-filter=AM -M --name-only --format= -- "$@" | awk '!seen[$0]++' |
    while read -r source; do [ ! -f "$source" ] || echo "$source"; done | head -n 40 |
    xargs -r -n 1 -P "$cores" clang-tidy -p "$build" --quiet
}
tidy build-tidy '*.cpp' ':!tests/reliability/fuzz' ':!tests/install/consumer'  # a project of its own
tidy build-fuzz 'tests/reliability/fuzz/*.cpp'

echo '== tests'
export OMP_NUM_THREADS=1
ctest --preset ci --parallel "$cores"

echo '== fuzz'
cmake --build --preset fuzz --parallel "$cores"
python3 tests/reliability/fuzz/fuzz.py --seconds 30
