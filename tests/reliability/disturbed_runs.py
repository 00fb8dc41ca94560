#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Disturbs commands and looks at what they leave: README.md says what must hold."""

import argparse
import collections
import concurrent.futures
import json
import os
import shutil
import sys
import tempfile
import time

import faults
import full_disk
import kills
import races
import scenarios

CAMPAIGNS = {"faults": faults, "races": races, "kills": kills, "full-disk": full_disk}
COLUMNS = ["runs", "reached", "exit 0", "exit 1", "exit 2", "exit 3", "of a library", "findings"]


def table(counts):
    lines = ["| command | " + " | ".join(COLUMNS) + " |", "|---" * (len(COLUMNS) + 1) + "|"]
    total = collections.Counter()
    for name, count in sorted(counts.items()):
        lines.append(f"| {name} | " + " | ".join(str(count[c]) for c in COLUMNS) + " |")
        if not name.startswith("kind: "):
            total += count
    lines.append("| all | " + " | ".join(str(total[c]) for c in COLUMNS) + " |")
    return "\n".join(lines)


def note(counts, result):
    for name in (result["name"], *(["kind: " + result["kind"]] if "kind" in result else [])):
        counts[name]["runs"] += 1
        counts[name]["reached"] += result["reached"]
        counts[name][f"exit {result['status']}"] += 1
        counts[name]["of a library"] += bool(result.get("library"))
        counts[name]["findings"] += bool(result["fault"])


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("campaign", choices=CAMPAIGNS)
    parser.add_argument("program", help="the flexneck to be tried")
    parser.add_argument("--shim", help="the library of fault_shim.cpp, for faults")
    parser.add_argument("--kinds", default="",
                        help="of faults: only those whose names begin with one of these")
    parser.add_argument("--runs", type=int, default=200)
    parser.add_argument("--first", type=int, default=0, help="of the runs, to go on with a campaign")
    parser.add_argument("--seed", default="1")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--commands", default="",
                        help="only those whose names begin with one of these, comma between")
    parser.add_argument("--only", default="", help="only these runs of the campaign, as in its log, comma between")
    parser.add_argument("--out", default="disturbed", help="folder for the log")
    options = parser.parse_args()
    options.program = os.path.abspath(options.program)
    options.shim = os.path.abspath(options.shim) if options.shim else None
    campaign = CAMPAIGNS[options.campaign]
    shutil.rmtree(options.out, ignore_errors=True)
    os.makedirs(options.out)
    begin = time.monotonic()
    counts = collections.defaultdict(collections.Counter)
    libraries = collections.Counter()
    with tempfile.TemporaryDirectory(prefix="undisturbed-") as base:
        made = campaign.prepare(options, scenarios.make(options.program, base, options.commands))
        tasks = [(options, made[i % len(made)], f"{options.seed}:{i}")
                 for i in range(options.first, options.runs)]
        tasks = [task for task in tasks if not options.only or task[2] in options.only.split(",")]
        with concurrent.futures.ProcessPoolExecutor(options.jobs) as pool, \
                open(os.path.join(options.out, "runs.jsonl"), "w", encoding="utf-8") as log:
            for result in pool.map(campaign.try_one, tasks):
                note(counts, result)
                libraries[result.get("library")] += bool(result.get("library"))
                log.write(json.dumps(result) + "\n")
                log.flush()
                if result["fault"] or options.only:
                    print(result["name"], result["seed"], result["what"], result["fault"],
                          result["text"][-300:].strip(), result.get("library", ""), flush=True)
    print(table(counts))
    for library, times in (+libraries).most_common():
        print(f"ended by a library for want of memory, {times} times: {library}")
    print(f"seed {options.seed}, {time.monotonic() - begin:.0f} s")
    sys.exit(any(count["findings"] for count in counts.values()))


if __name__ == "__main__":
    main()
