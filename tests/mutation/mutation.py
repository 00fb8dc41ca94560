#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Changes the numeric code at places drawn by a seed and sees whether the tests notice (README.md).

Usage: mutation.py [--sites N] [--seed S] [--rooms ROOM …] [--jobs N] [--work FOLDER] [--out FOLDER]
"""

import argparse
import concurrent.futures
import json
import os
import re
import shlex
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import sites

ROOT = Path(__file__).resolve().parents[2]
# Folders whose code is changed, and the tests that should notice, by the part of their names before
# the colon. The last tests of a folder reach its code through the command.
ROOMS = {
    "mesher": (["mesher"], ["mesh", "shape_functions", "mesher", "partition", "drawing", "exchange", "neck", "chain",
                            "golden"]),
    "mesher/mesh": (["mesher/mesh"], ["mesh", "shape_functions"]),
    "fe_modal": (["fe_modal"], ["fe_modal", "modal_body", "corner_fields", "ranks", "golden"]),
    "multibody": (["multibody"], ["multibody", "multibody_system", "multibody_runs", "mass_ratios", "reference",
                                  "golden"]),
    "pipeline": (["pipeline/experiments", "pipeline/language/model", "pipeline/process", "pipeline/results/tables",
                  "pipeline/laboratory/verdict"],
                 ["experiments", "language", "process", "verdict", "command", "model_runs", "report", "golden"]),
}
SCRIPTS = {"golden"}  # tests without a program of their own, which run the command
DEFAULT = ["fe_modal", "mesher", "multibody", "pipeline"]
SWITCH = """#pragma once
#ifdef __cplusplus
#include <cstdlib>
inline bool flexneck_mutant(int number) {
  static const int active = [] {
    const char* text = std::getenv("FLEXNECK_MUTANT");
    return text == nullptr ? 0 : std::atoi(text);
  }();
  return number == active;
}
#endif
"""
SLOWEST = 10  # multiple of a test's time without mutation
LEAST_LIMIT_S = 5
SKIPPED = 77


def run(command, **options):
    return subprocess.run(command, check=False, capture_output=True, text=True, **options)


class Campaign:
    def __init__(self, options):
        self.options = options
        self.work = Path(options.work).resolve()
        self.tree, self.build = self.work / "tree", self.work / "build"
        self.mutants_file, self.results_file = self.work / "mutants.json", self.work / "results.jsonl"
        self.pool = concurrent.futures.ThreadPoolExecutor(options.jobs)
        names = {name for room in options.rooms for name in ROOMS[room][1]}
        self.targets = [f"test_{name}" for name in sorted(names - SCRIPTS)]
        if names & SCRIPTS or "pipeline" in options.rooms:
            self.targets.append("flexneck")

    def prepare(self):
        """A copy of the sources, configured."""
        if (self.build / "compile_commands.json").exists():
            return
        shutil.rmtree(self.work, ignore_errors=True)
        for name in run(["git", "ls-files"], cwd=ROOT).stdout.splitlines():
            target = self.tree / name
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(ROOT / name, target)
        (self.work / "switch.h").write_text(SWITCH)
        done = run(["cmake", "-S", self.tree, "-B", self.build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                    "-DFLEXNECK_TESTS=ON", "-DCMAKE_EXPORT_COMPILE_COMMANDS=ON",
                    "-DFLEXNECK_PRECOMPILED_HEADERS=OFF",  # the switch comes first
                    "-DCMAKE_CXX_FLAGS_RELEASE=-O2",  # with assertions, which see what runs out of an array
                    f"-DCMAKE_CXX_FLAGS=-w -D_GLIBCXX_ASSERTIONS -include {self.work / 'switch.h'}"])
        if done.returncode != 0:
            sys.exit(done.stdout + done.stderr)

    def sources_of(self, room):
        for folder in ROOMS[room][0]:
            for path in sorted((ROOT / folder).rglob("*")):
                if path.suffix in (".cpp", ".h"):
                    yield sites.File(str(path.relative_to(ROOT)), path.read_text())

    def draw(self):
        """Mutants that compile, written into the copy of the sources."""
        if self.mutants_file.exists():
            return json.loads(self.mutants_file.read_text())
        commands = {entry["file"]: entry for entry in
                    json.loads((self.build / "compile_commands.json").read_text())}
        rooms = {file: room for room in self.options.rooms for file in self.sources_of(room)}
        for file in rooms:
            self.write(file, [])  # as it was, if a drawing was interrupted
        edits, mutants, failed = {}, [], 0
        for file, token, text in sites.draw(list(rooms), self.options.seed):
            if len(mutants) == self.options.sites:
                break
            switch = f"flexneck_mutant({len(mutants) + 1})"
            forms = file.forms(token, text, switch)
            accepted = self.accept(file, forms, edits.setdefault(file.path, []), commands)
            if accepted is None:
                continue
            if not accepted:
                failed += 1
                continue
            line = file.source.count("\n", 0, file.tokens[token].begin) + 1
            mutants.append({"number": len(mutants) + 1, "room": rooms[file], "site": f"{file.path}:{line}",
                            "change": f"{file.tokens[token].text} -> {text or 'nothing'}",
                            "code": file.source.splitlines()[line - 1].strip()})
            print(f"{len(mutants)}: {mutants[-1]['site']}: {mutants[-1]['change']}", flush=True)
        drawn = {"mutants": mutants, "not compiled": failed}
        self.mutants_file.write_text(json.dumps(drawn, indent=1))
        return drawn

    def accept(self, file, forms, edits, commands):
        """Whether a form compiles beside the edits that are there, to which it is then added; None: it overlaps
        them, or there is no form."""
        tried = None
        for form in forms:
            if any(form[0] < end and begin < form[1] for begin, end, _ in edits):
                continue
            tried = False
            self.write(file, [*edits, form])
            if self.compiles(file.path, commands):
                edits.append(form)
                return True
        self.write(file, edits)
        return tried

    def write(self, file, edits):
        source = file.source
        for begin, end, text in sorted(edits, reverse=True):
            source = source[:begin] + text + source[end:]
        (self.tree / file.path).write_text(source)

    def compiles(self, path, commands):
        user = path if path.endswith(".cpp") else self.user_of(path)
        entry = commands.get(str(self.tree / user)) if user else None
        if entry is None:
            return False
        words = shlex.split(entry["command"])
        output = words.index("-o")
        return run([*words[:output], "-fsyntax-only", *words[output + 2:]], cwd=entry["directory"]).returncode == 0

    def user_of(self, header):
        """A source that includes the header, its own if there is one."""
        own = header.removesuffix(".h") + ".cpp"
        if (self.tree / own).exists():
            return own
        folders = [folder for room in DEFAULT for folder in ROOMS[room][0]]
        return next((str(path.relative_to(self.tree)) for folder in folders
                     for path in sorted((self.tree / folder).rglob("*.cpp"))
                     if f'#include "{header}"' in path.read_text()), None)

    def compile(self):
        done = run(["cmake", "--build", self.build, "--target", *self.targets])
        if done.returncode != 0:
            sys.exit(done.stdout[-4000:] + "the mutants compile one by one, but not together")

    def tests(self):
        """Commands of each room's tests, quickest first, with their times."""
        listed = json.loads(run(["ctest", "--show-only=json-v1"], cwd=self.build).stdout)["tests"]
        found = {room: [] for room in self.options.rooms}

        def measure(test):
            folder = {entry["name"]: entry["value"] for entry in test["properties"]}["WORKING_DIRECTORY"]
            return test, folder, *self.call(test["command"], folder, 0, 3600)

        rooms_of = lambda test: [room for room in self.options.rooms if test["name"].split(":")[0] in ROOMS[room][1]]
        wanted = [test for test in listed if "command" in test and rooms_of(test)]
        for test, folder, seconds, code in self.pool.map(measure, wanted):
            if code == 0:
                for room in rooms_of(test):
                    found[room].append((seconds, test["name"], test["command"], folder))
            elif code != SKIPPED:
                print(f"fails unchanged, and is left out: {test['name']}", flush=True)
        return {room: sorted(tests) for room, tests in found.items()}

    def call(self, command, folder, mutant, limit_s):
        """Seconds and exit code; none for the time limit."""
        begin = time.monotonic()
        environment = os.environ | {"FLEXNECK_MUTANT": str(mutant), "OMP_NUM_THREADS": "1"}
        process = subprocess.Popen(command, cwd=folder, env=environment, stdout=subprocess.DEVNULL,
                                   stderr=subprocess.DEVNULL, start_new_session=True)
        try:
            code = process.wait(limit_s)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            process.wait()
            code = None
        return time.monotonic() - begin, code

    def outcome(self, mutant, tests):
        for seconds, name, command, folder in tests:
            _, code = self.call(command, folder, mutant["number"], max(SLOWEST * seconds, LEAST_LIMIT_S))
            if code is None:
                return {"outcome": "timeout", "by": name}
            if code not in (0, SKIPPED):
                return {"outcome": "killed", "by": name}
        return {"outcome": "survived", "by": ""}

    def run(self):
        self.prepare()
        drawn = self.draw()
        self.compile()
        done = {}
        if self.results_file.exists():
            for line in self.results_file.read_text().splitlines():
                done[json.loads(line)["number"]] = json.loads(line)
        tests = self.tests() if len(done) < len(drawn["mutants"]) else {}
        work = {self.pool.submit(self.outcome, mutant, tests[mutant["room"]]): mutant
                for mutant in drawn["mutants"] if mutant["number"] not in done}
        for finished in concurrent.futures.as_completed(work):
            row = work[finished] | finished.result()
            done[row["number"]] = row
            with self.results_file.open("a") as file:
                file.write(json.dumps(row) + "\n")
            print(f"{row['number']}: {row['outcome']}", flush=True)
        return self.report([done[mutant["number"]] for mutant in drawn["mutants"]], drawn["not compiled"])

    def report(self, rows, failed):
        noticed = sum(row["outcome"] != "survived" for row in rows)
        score = 100 * noticed / max(len(rows), 1)
        escaped = lambda text: re.sub(r"([|`])", r"\\\1", text)
        lines = [f"Seed {self.options.seed}: {noticed} of {len(rows)} noticed, {score:.0f} %; {failed} drawn anew, "
                 "since they did not compile.", "", "| site | change | code | outcome | by |", "|---|---|---|---|---|"]
        lines += [f"| {row['site']} | {escaped(row['change'])} | {escaped(row['code'])} | {row['outcome']} | "
                  f"{escaped(row['by'])} |" for row in sorted(rows, key=lambda row: row["outcome"] != "survived")]
        out = Path(self.options.out or self.work)
        out.mkdir(parents=True, exist_ok=True)
        (out / "mutants.md").write_text("\n".join(lines) + "\n")
        print(f"{lines[0]} Table: {out / 'mutants.md'}")
        return 0 if score >= 90 else 1


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    head = run(["git", "rev-parse", "--short=12", "HEAD"], cwd=ROOT).stdout.strip()
    parser.add_argument("--sites", type=int, default=150)
    parser.add_argument("--seed", default=head)
    parser.add_argument("--rooms", nargs="+", choices=ROOMS, default=DEFAULT)
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="tests at once")
    parser.add_argument("--work", help="where to build; what is there already is gone on with")
    parser.add_argument("--out", help="where the table goes (default: the work folder)")
    options = parser.parse_args()
    if options.work is None:
        rooms = "+".join(room.replace("/", "-") for room in options.rooms)
        options.work = ROOT / "build" / "mutation" / f"{options.seed}-{options.sites}-{rooms}"
    return Campaign(options).run()


if __name__ == "__main__":
    sys.exit(main())
