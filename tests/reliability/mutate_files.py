#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Damages files of every format and gives them to the command: README.md says what must hold."""

import argparse
import collections
import concurrent.futures
import json
import os
import random
import re
import resource
import shutil
import subprocess
import sys
import tempfile
import time

import mutations
import sound_files

MEMORY = 1 << 30  # and twice the file
SECONDS = 20  # of the processor; on the clock CLOCK times as much, for a machine with other work
CLOCK = 30
# Texts that report the death of a child.
CONTAINED = re.compile(r"crashed while reading it|did not finish reading it|needs more than|failed to read it|was killed")


def limit():
    """What the command must not need; its children inherit it."""
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    resource.setrlimit(resource.RLIMIT_FSIZE, (1 << 30, 1 << 30))
    os.nice(10)


def run(program, arguments, folder):
    """Exit status, text, seconds of the processor and the most memory of the command and its
    children."""
    with tempfile.TemporaryFile(dir=folder) as text:
        start = time.monotonic()
        process = subprocess.Popen([program, *arguments, "-q"], cwd=folder, stdout=text,
                                   stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL,
                                   preexec_fn=limit, start_new_session=True)
        status = None
        while status is None:
            done, state, usage = os.wait4(process.pid, os.WNOHANG)
            if done:
                status = os.waitstatus_to_exitcode(state)
            elif time.monotonic() - start > CLOCK * SECONDS:
                os.killpg(process.pid, 9)
                _, _, usage = os.wait4(process.pid, 0)
                status = "hang"
            else:
                time.sleep(0.02)
        process.returncode = 0
        text.seek(0)
        shown = text.read(1 << 16).decode("utf-8", "replace")
    return status, shown, usage.ru_utime + usage.ru_stime, usage.ru_maxrss * 1024


def fault_of(status, text, seconds, memory, size):
    """What is wrong with how a command ended; empty if nothing is."""
    if status == "hang":
        return "hang"
    if status < 0:
        return f"signal {-status}"
    if status not in (0, 1, 2, 3):
        return f"exit {status}"
    if seconds > SECONDS:
        return f"{seconds:.0f} s"
    if memory > MEMORY + 2 * size:
        return f"{memory / 2**20:.0f} MB"
    lines = [line for line in text.splitlines() if not line.startswith("Warning: ")]
    if status in (2, 3) and (len(lines) != 1 or not lines[0].startswith("flexneck: ")):
        return f"{len(lines)} lines"
    if re.search(r"[\x00-\x08\x0b-\x1f\x7f]", text):
        return "control characters"
    if status == 0 and re.search(r"(?<![a-z])-?(nan|inf)(?![a-z])", text):
        return "not a number"
    return ""


def kind_of(text):
    """A message without what differs from file to file."""
    text = re.sub(r"^flexneck: \S+: ", "", text.strip().splitlines()[-1] if text.strip() else "")
    return re.sub(r"[-+]?\d[\d.e+-]*", "N", text)[:100]


def try_one(task):
    program, sound, each, seed, stacks = task
    generator = random.Random(f"{seed}")
    with tempfile.TemporaryDirectory(prefix="mutate-") as folder:
        work = os.path.join(folder, "work")
        shutil.copytree(sound, work)
        path = os.path.join(work, each.file)
        with open(path, "rb") as file:
            contents = file.read()
        damaged, done = mutations.damage(generator, contents, each.text, each.file.endswith(".h5"))
        with open(path, "wb") as file:
            file.write(damaged)
        result = {"format": each.name, "seed": seed, "damage": done, "fault": ""}
        for arguments in each.commands:
            status, text, seconds, memory = run(program, arguments, work)
            result.update(command=arguments, status=status, seconds=round(seconds, 2),
                          megabytes=memory >> 20, text=text[-400:], message=kind_of(text))
            result["fault"] = fault_of(status, text, seconds, memory, len(damaged))
            if result["fault"] or status != 0:
                break
        result["contents"] = damaged
        if stacks and "crashed while reading it" in result["text"]:
            result["stack"] = stack_of(program, sound, each, result, damaged)
    return result


def keep(folder, result):
    """Keeps the damaged file beside a record of what it does."""
    contents = result.pop("contents")
    if not result["fault"] and not CONTAINED.search(result["text"]):
        return
    name = f"{result['format'].replace('/', '-')}-{result['seed'].replace(':', '-')}"
    with open(os.path.join(folder, name), "wb") as file:
        file.write(contents)


def stack_of(program, sound, each, result, contents):
    """Functions on the stack of a child that crashes, innermost first, as gdb tells them."""
    with tempfile.TemporaryDirectory(prefix="stack-") as folder:
        work = os.path.join(folder, "work")
        shutil.copytree(sound, work)
        with open(os.path.join(work, each.file), "wb") as file:
            file.write(contents)
        gdb = ["gdb", "-batch", "-ex", "set follow-fork-mode child", "-ex", "run", "-ex", "bt 6",
               "--args", program, *result["command"], "-q"]
        text = subprocess.run(gdb, cwd=work, capture_output=True, check=False).stdout
    frames = re.findall(rb"^#\d+ +(?:0x[0-9a-f]+ in )?([^ (]+)", text, re.MULTILINE)
    return " < ".join(frame.decode() for frame in frames)


def table(counts):
    """Rows of the formats: runs, exit codes, what a child contained, faults."""
    columns = ["runs", "exit 0", "exit 1", "exit 2", "exit 3", "contained", "faults"]
    lines = ["| format | " + " | ".join(columns) + " |", "|---" * (len(columns) + 1) + "|"]
    total = collections.Counter()
    for name, count in counts.items():
        lines.append(f"| {name} | " + " | ".join(str(count[c]) for c in columns) + " |")
        total += count
    lines.append("| all | " + " | ".join(str(total[c]) for c in columns) + " |")
    return "\n".join(lines)


def write_counts(path, counts):
    with open(path, "w", encoding="utf-8") as file:
        for key, number in counts.most_common():
            file.write(f"{number}\t" + "\t".join(map(str, key)) + "\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", help="the flexneck to be tried")
    parser.add_argument("--runs", type=int, default=20000)
    parser.add_argument("--seed", default="1")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--formats", default="",
                        help="only those whose names begin with one of these, comma between")
    parser.add_argument("--out", default="mutated", help="folder for what fails")
    parser.add_argument("--stacks", action="store_true",
                        help="run what crashes a child again under gdb: stacks.txt")
    options = parser.parse_args()
    program = os.path.abspath(options.program)
    shutil.rmtree(options.out, ignore_errors=True)
    os.makedirs(options.out)
    start = time.monotonic()
    with tempfile.TemporaryDirectory(prefix="sound-") as sound:
        small = os.path.join(sound, "small")
        results = os.path.join(sound, "results")
        wanted = tuple(options.formats.split(","))
        formats = [(small, each) for each in sound_files.make(program, small)]
        if any("results".startswith(name.split("/")[0]) for name in wanted):
            formats += [(results, each) for each in sound_files.make_results(program, results)]
        formats = [pair for pair in formats if pair[1].name.startswith(wanted)]
        tasks = [(program, *formats[i % len(formats)], f"{options.seed}:{i}", options.stacks)
                 for i in range(options.runs)]
        counts = {each.name: collections.Counter() for _, each in formats}
        messages = collections.Counter()
        stacks = collections.Counter()
        with concurrent.futures.ProcessPoolExecutor(options.jobs) as pool, \
                open(os.path.join(options.out, "runs.jsonl"), "w", encoding="utf-8") as log:
            for result in pool.map(try_one, tasks):
                keep(options.out, result)
                count = counts[result["format"]]
                count["runs"] += 1
                count[f"exit {result['status']}"] += 1
                count["faults"] += bool(result["fault"])
                count["contained"] += bool(CONTAINED.search(result["text"]))
                stacks[(result["format"], result.get("stack", ""))] += "stack" in result
                messages[(result["format"], result["status"], result["message"])] += 1
                log.write(json.dumps(result) + "\n")
                log.flush()
                if result["fault"]:
                    print(result["format"], result["seed"], result["fault"], result["damage"],
                          result["text"][-200:].strip(), flush=True)
    print(table(counts))
    print(f"seed {options.seed}, {time.monotonic() - start:.0f} s")
    write_counts(os.path.join(options.out, "messages.txt"), messages)
    write_counts(os.path.join(options.out, "stacks.txt"), +stacks)
    sys.exit(any(count["faults"] for count in counts.values()))


if __name__ == "__main__":
    main()
