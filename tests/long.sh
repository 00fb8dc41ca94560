#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs a long campaign and notes its outcome in tests/reliability/campaigns.md.
# Usage: sh tests/long.sh NAME [SEED [COUNT]]     (no NAME: the list; SEED: the commit's hash)
# What fails is kept in build/long/NAME. Exit code: that of the campaign, 0 for no finding.
set -eu

root=$(cd "$(dirname "$0")/.." && pwd)
cd "$root"
notes=tests/reliability/campaigns.md

# NAME COUNT COMMAND, which finds $seed, $count and $out, a fresh folder.
campaigns='
mutation-of-files 20000 python3 tests/reliability/mutate_files.py build/flexneck --seed $seed --runs $count --out $out
faults 2000 python3 -B tests/reliability/disturbed_runs.py faults build/flexneck --shim build/tests/reliability/fault_shim.so --jobs 1 --seed $seed --runs $count --out $out
races 1000 python3 -B tests/reliability/disturbed_runs.py races build/flexneck --jobs 1 --seed $seed --runs $count --out $out
kills 200 python3 -B tests/reliability/disturbed_runs.py kills build/flexneck --jobs 1 --seed $seed --runs $count --out $out
full-disk 200 python3 -B tests/reliability/disturbed_runs.py full-disk build/flexneck --jobs 1 --seed $seed --runs $count --out $out
large-bending 1 python3 -B tests/pipeline/cli/large_bending.py build/flexneck --seed $seed --runs $count --out $out
fit-coverage 50 python3 -B tests/pipeline/parameter_studies/fit/chain_coverage.py build/flexneck --seed $seed --runs $count --out $out
fuzz 1000000 python3 tests/reliability/fuzz/fuzz.py --seed $seed --runs $count --out $out
sanitize 1 run_under sanitize
thread 20 run_under thread
readme 1 python3 -B tests/readme/readme_test.py "$root/build" "$root" --whole
manual 1 cmake --build "$root/build" --target manual
package 1 sh tests/install/package.sh "$root/build" "$out"
debian13 1 sh tests/install/debian13.sh "$out"
tidy 1 tidy_all
python-leaks 10000 env PYTHONPATH=build/python /usr/bin/python3 -B tests/pipeline/python/package_test.py build . --calls $count Leaks
pulses 1000 build/tests/campaigns/campaign_pulses --seed $seed --runs $count --out $out
bounces 1000 build/tests/campaigns/campaign_bounces --seed $seed --runs $count --out $out
trees-and-loops 1000 build/tests/campaigns/campaign_trees_and_loops --seed $seed --runs $count --out $out
decks 1000 build/tests/campaigns/campaign_decks --seed $seed --runs $count --out $out
constrained-bodies 1000 build/tests/campaigns/campaign_constrained_bodies --seed $seed --runs $count --out $out
mutation 150 python3 -B tests/mutation/mutation.py --seed $seed --sites $count --out $out
'

# Runs the tests of a preset of sanitizers $count times.
run_under() {
  cmake --preset "$1" && cmake --build --preset "$1" &&
    OMP_NUM_THREADS=1 ctest --preset "$1" --parallel "$(nproc)" --repeat "until-fail:$count" \
      --output-log "$root/$out/log"
}

# clang-tidy on every source.
tidy_all() {
  cmake --preset tidy -DFLEXNECK_TESTS=ON >/dev/null &&
    git ls-files '*.cpp' ':!tests/reliability/fuzz' ':!tests/install/consumer' |
      xargs -n 1 -P "$(nproc)" clang-tidy -p build-tidy --quiet
}

if [ $# -lt 1 ]; then
  echo "$campaigns" | awk 'NF { printf "%-20s %s\n", $1, $2 }'
  exit 0
fi
name=$1
line=$(echo "$campaigns" | awk -v name="$name" '$1 == name')
[ -n "$line" ] || { echo "there is no campaign '$name'; 'sh tests/long.sh' lists them"; exit 2; }
commit=$(git rev-parse --short=12 HEAD)
git diff --quiet HEAD -- || commit="$commit and changes"
seed=${2:-$(git rev-parse --short=12 HEAD)}
count=${3:-$(echo "$line" | awk '{ print $2 }')}
out=build/long/$name
rm -rf "$out"
mkdir -p "$out"

begin=$(date +%s)
code=0
eval "$(echo "$line" | cut -d' ' -f3-)" || code=$?
seconds=$(($(date +%s) - begin))

outcome="no finding"
[ "$code" = 0 ] || outcome="exit code $code"
grep -v "^| $name |" "$notes" > "$out/notes"
echo "| $name | $commit | $seed | $count | $seconds | $outcome |" >> "$out/notes"
mv "$out/notes" "$notes"
exit "$code"
