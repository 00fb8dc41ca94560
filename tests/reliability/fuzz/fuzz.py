#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the fuzz targets on every reader for a time or a number of executions: README.md."""

import argparse
import concurrent.futures
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
import seeds

HDF5 = ("history", "mesh", "modes")
SECONDS = 10  # for one input
MEGABYTES = 2048
LONGEST = 4096  # bytes of an input
# A smaller quarantine of freed memory, for speed.
ASAN = "quarantine_size_mb=16:malloc_context_size=4"
LEAKS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "leaks.txt")  # of libraries


def command_of(options, target, seconds, count):
    corpus = os.path.join(options.out, "corpus")
    command = [os.path.join(options.build, "tests/reliability/fuzz", "fuzz_" + target),
               os.path.join(corpus, target), f"-seed={options.seed}", f"-timeout={SECONDS}", f"-rss_limit_mb={MEGABYTES}",
               f"-max_len={LONGEST}", f"-artifact_prefix={options.out}/{target}-",
               "-print_final_stats=1", "-reload=0", "-entropic_scale_per_exec_time=1"]
    if target not in HDF5:
        command.append(f"-dict={corpus}/{target}.dict")
    return command + ([f"-runs={count}"] if count else [f"-max_total_time={seconds}"])


def run(options, target, seconds):
    """Executions, seconds and how it ended; the log is kept beside what was found."""
    count = options.runs // (10 if target in HDF5 else 1)
    log = os.path.join(options.out, target + ".log")
    start = time.monotonic()
    memory = "/dev/shm" if os.path.isdir("/dev/shm") else None
    with tempfile.TemporaryDirectory(prefix="fuzz-", dir=memory) as folder, \
            open(log, "wb") as text:
        code = subprocess.run(command_of(options, target, seconds, count), stdout=text,
                              stderr=subprocess.STDOUT, check=False,
                              env={**os.environ, "TMPDIR": folder, "ASAN_OPTIONS": ASAN,
                                   "LSAN_OPTIONS": f"suppressions={LEAKS}:print_suppressions=0"}).returncode
    with open(log, encoding="utf-8", errors="replace") as file:
        told = file.read()
    executions = re.search(r"number_of_executed_units: *(\d+)", told)
    return {"target": target, "executions": int(executions[1]) if executions else 0,
            "seconds": time.monotonic() - start, "code": code, "finding": finding_in(told, code)}


def finding_in(told, code):
    """The line that says what is wrong, and the first function of ours on the stack."""
    if code == 0:
        return ""
    said = re.search(r"(does not hold:.*|runtime error:.*|ERROR: \w*Sanitizer:.*|ERROR: libFuzzer:.*"
                     r"|terminate called.*\n.*what.*)", told)
    where = re.search(r"#\d+ 0x\w+ in (flexneck::[^ (]*)", told)
    return (said[1] if said else f"exit {code}") + (f" in {where[1]}" if where else "")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("targets", nargs="*", help="all if none is named")
    parser.add_argument("--build", default="build-fuzz")
    parser.add_argument("--seconds", type=int, default=180, help="for all targets together")
    parser.add_argument("--runs", type=int, default=0,
                        help="of each target in place of a time; a tenth for HDF5 files")
    parser.add_argument("--seed", default="1")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--out", default="build-fuzz/found", help="folder for corpus and findings")
    options = parser.parse_args()
    options.seed = int(options.seed, 16) % (1 << 31) or 1
    shutil.rmtree(options.out, ignore_errors=True)
    known = seeds.write(os.path.join(options.out, "corpus"))
    targets = options.targets or known
    seconds = max(1, options.seconds * options.jobs // len(targets))
    found = False
    print("| target | executions | seconds | a second | finding |\n|---|---|---|---|---|")
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for result in pool.map(lambda target: run(options, target, seconds), targets):
            found = found or result["code"] != 0
            rate = result["executions"] / max(result["seconds"], 1e-3)
            print(f"| {result['target']} | {result['executions']} | {result['seconds']:.0f} | "
                  f"{rate:.0f} | {result['finding'].replace('|', '/')} |", flush=True)
    sys.exit(found)


if __name__ == "__main__":
    main()
