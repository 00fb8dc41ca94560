#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Counts the instructions of an evaluation and of an output of the equations of motion, and compares
them with the counts stored here, or stores them anew.

Usage: instructions_test.py compare|store COUNT_INSTRUCTIONS "COMPILER VERSION BUILD"
(77: skipped, for want of valgrind or since the counts are another compiler's)
"""

import csv
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

STORED = Path(__file__).resolve().parent / "tables" / "instructions.csv"
MOST_GROWTH = 0.03
SKIPPED = 77


def instructions_in(path, program):
    """Those of the program itself: libc and libm choose their code by the processor."""
    names = {}  # an object is named once, then by its number
    total = 0
    is_ours = is_call = False
    for line in path.read_text(encoding="utf-8").splitlines():
        if named := re.match(r"(c?ob)=(\(\d+\))(?: (.*))?", line):
            key, number, name = named.groups()
            names.setdefault(number, name)
            if key == "ob":
                is_ours = names[number] == program
        elif line.startswith("calls="):
            is_call = True  # the next line is what the callee took
        elif re.match(r"[-+*\d]", line):
            if is_ours and not is_call:
                total += int(line.split()[1])
            is_call = False
    return total


def count(program):
    """Instructions by name: the program does each twice, once as often the second time."""
    totals = {}
    with tempfile.TemporaryDirectory() as folder:
        parts = f"{folder}/parts"
        done = subprocess.run(["valgrind", "--tool=callgrind", f"--callgrind-out-file={parts}",
                               "--dump-before=begin_part", program],
                              check=True, capture_output=True, text=True)
        for k, line in enumerate(done.stdout.splitlines(), start=2):  # before the first, the start
            name, _, times = line.rpartition(": ")
            if name:
                totals.setdefault(name, []).append(
                    (int(times), instructions_in(Path(f"{parts}.{k}"), program)))
    return {name: round((more - less) / (more_times - less_times))
            for name, ((less_times, less), (more_times, more)) in totals.items()}


def store(counts, compiler):
    with open(STORED, "w", newline="", encoding="utf-8") as file:
        csv.writer(file, lineterminator="\n").writerows([("name", compiler), *counts.items()])


def compare(counts, compiler):
    with open(STORED, newline="", encoding="utf-8") as file:
        (_, stored_compiler), *rows = csv.reader(file)
    if compiler != stored_compiler:
        print(f"SKIPPED: the counts are of {stored_compiler}, this is {compiler}")
        return SKIPPED
    stored = {name: int(number) for name, number in rows}
    print(f"{'instructions':40} {'stored':>10} {'found':>10} {'growth %':>9}")
    failed = stored.keys() != counts.keys()
    for name in {**stored, **counts}:
        old, new = stored.get(name, 0), counts.get(name, 0)
        growth = (new - old) / old if old else float("inf")
        print(f"{name:40} {old:10} {new:10} {100 * growth:+9.2f}")
        failed = failed or growth > MOST_GROWTH or new == 0
    return 1 if failed else 0


def main(action, program, compiler):
    if not shutil.which("valgrind"):
        print("SKIPPED: there is no valgrind; install valgrind")
        return SKIPPED
    counts = count(str(Path(program).resolve()))
    return {"compare": compare, "store": store}[action](counts, compiler)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
