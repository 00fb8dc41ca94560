#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the commands of every README, and of the heads of shipped files, in a folder where the READMEs' own
studies and a run stand. By default on the coarsest neck, with few cases and short runs; --whole as they stand.

Usage: readme_test.py BUILD SOURCES [--whole] [README …]
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import commands

WHOLE = "--whole" in sys.argv
BUILD, SOURCES, *ONLY = [word for word in sys.argv[1:] if word != "--whole"]
BUILD, SOURCES = Path(BUILD), Path(SOURCES)

# Commands that no test runs, with the reason. Each pattern has to match some command.
LEFT_OUT = {
    r"^sh (pipeline/run|tests/run|cmake/setup)\.sh": "installs packages, builds",
    r"^python3 tests/(reliability|mutation)/": "a campaign of hours",
    r"^cmake ": "builds",
    r"^parallel ": "GNU parallel is no package of ours",
}
# Commands that only --whole runs.
SLOW = r"qualif|\bfit (pipeline|six|weight|head_)|fits/|lab-fit|--sensitivity|modes -v --check|modes --check -o"
COARSE = ["mesh.quadrant=2", "mesh.inner_ring=2", "mesh.outer_ring=1", "mesh.rubber_layers=1",
          "geometry.bolt_patch_radius='0.4 in'"]
FEW = ["cases=['flexion-20','flexion-60','flexion-80','flexion-120','flexion']", "pendulum.duration='0.2 s'",
       "test=[]"]
MODEL = ["solver.end_time='20 ms'"]
ENVIRONMENT = {**os.environ, "PATH": f"{BUILD}:{os.environ['PATH']}", "OMP_NUM_THREADS": "1",
               "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
               "OMPI_MCA_rmaps_base_oversubscribe": "1"}


def shortened(command):
    """With settings that make it quick."""
    if WHOLE:
        return command
    if " && " in command:
        return " && ".join(shortened(part) for part in command.split(" && "))
    line = re.sub(r"\s+#\s.*$", "", command)
    settings = []
    name = re.search(r"flexneck (\w+)", line)
    kind = name[1] if name else ""
    other = re.search(r"cantilever|seat_back|mixed|my_deck|examples/", line)
    if kind in ("run", "mesh") and not other:
        settings = [each for each in COARSE if each.split("=")[0] not in line]
        settings += FEW if kind == "run" else []
    if kind == "simulate":
        settings = [each for each in MODEL if each.split("=")[0] not in line]
    if kind == "sweep":
        settings = [*COARSE, "sweep.samples=2", "pendulum.duration='0.1 s'"]
    if kind == "fit":
        settings = [*COARSE, "fit.starts=1", "fit.history_samples=2", "pendulum.duration='0.25 s'"]
    quoted = " ".join(f'--set "{each}"' if "'" in each else f"--set {each}" for each in settings)
    return f"{line} {quoted}"


def mme_channel(code, unit, values):
    head = {"Channel code": code, "Unit": unit, "Time of first sample": 0, "Sampling interval": 1e-4,
            "Number of samples": len(values)}
    return "".join(f"{key:<28}:{value}\n" for key, value in head.items()) + "".join(f"{v}\n" for v in values)


def lab12(folder):
    """A test with the loads that a load cell above the condyles measures."""
    (folder / "lab12/Channel").mkdir(parents=True)
    (folder / "lab12/lab12.mme").write_text("Data format edition number  :1.6\nLaboratory test ref. number :lab12\n")
    codes = {"11NECKUP00H3FOZA": "N", "11NECKUP00H3MOYB": "Nm", "11NECKUP00H3FOXA": "N", "11TMONUP00H3MOYB": "Nm"}
    index = f"Number of channels          :{len(codes)}\n"
    for k, (code, unit) in enumerate(codes.items()):
        values = [1000 * k + i % 7 for i in range(500)]
        (folder / f"lab12/Channel/lab12.{k + 1:03}").write_text(mme_channel(code, unit, values))
        index += f"Name of channel {k + 1:03}         :{code}\n"
    (folder / "lab12/Channel/lab12.chn").write_text(index)


def reader_s_own(readme, folder):
    """Files that a README speaks of as the reader's."""
    for name, text in readme.files.items():
        (folder / name).write_text(text + "\n")
    text = " ".join(readme.commands)
    if "measured.csv" in text:
        rows = "".join(f"{0.001 * i},{min(i, 60)}\n" for i in range(120))
        (folder / "measured.csv").write_text("time [s],angle [deg]\n" + rows)
    if "loads.csv" in text:
        rows = "".join(f"{1e-4 * i},{i % 50},{i % 9}\n" for i in range(400))
        (folder / "loads.csv").write_text("time [s],Fz [N],My [N*m]\n" + rows)
    if "lab12" in text and "lab12.mme" not in " ".join(re.findall(r"--to (\S+)", text)):
        lab12(folder)


class Session:
    def __init__(self):
        self.top = Path(tempfile.mkdtemp(prefix="flexneck-readme-"))
        self.problems, self.count, self.used = [], 0, set()

    def tell(self, problem):
        """At once, too: a campaign takes hours and may be ended before."""
        print(f"PROBLEM {problem}", flush=True)
        self.problems.append(problem)

    def folder_for(self, readme, with_run):
        folder = self.top / re.sub(r"\W+", "_", readme.path)
        folder.mkdir()
        (folder / "build").symlink_to(BUILD)
        for name in ("pipeline", "geometry", "tests"):
            (folder / name).symlink_to(SOURCES / name)
        if with_run:
            shutil.copytree(self.run_folder(), folder / "out")
        reader_s_own(readme, folder)
        return folder

    def run_folder(self):
        """Of the built-in study, once for all."""
        out = self.top / "out"
        if not out.exists():
            self.shell("flexneck run -o out", self.top, {0, 1})
        return out

    def shell(self, command, folder, fine=frozenset({0})):
        line = shortened(command)
        begin = time.monotonic()
        outcome = subprocess.run(line, shell=True, cwd=folder, env=ENVIRONMENT, stdout=subprocess.PIPE,
                                 stderr=subprocess.STDOUT, text=True, check=False, executable="/bin/bash")
        print(f"{time.monotonic() - begin:6.1f} s  {command}", flush=True)
        if outcome.returncode not in fine:
            self.tell(f"{folder.name}: exit code {outcome.returncode}: {line}\n{outcome.stdout[-2000:]}")

    def command(self, command, folder):
        for pattern in LEFT_OUT:
            if re.search(pattern, command):
                self.used.add(pattern)
                return
        if not WHOLE and re.search(SLOW, command):
            return
        self.count += 1
        # The coarsest neck may miss a published frequency.
        self.shell(command, folder, {0, 1} if re.search(r"flexneck (run|verify)", command) and not WHOLE else {0})

    def python(self, text, folder):
        self.count += 1
        # matplotlib needs 188 packages: a stand-in checks that the data can be drawn.
        path = f"{BUILD}/python:{Path(__file__).resolve().parent / 'stand_in'}"
        outcome = subprocess.run(["/usr/bin/python3", "-c", text], cwd=folder, stdout=subprocess.PIPE,
                                 stderr=subprocess.STDOUT, text=True, check=False,
                                 env={**ENVIRONMENT, "PYTHONPATH": path})
        if outcome.returncode != 0:
            self.tell(f"{folder.name}: {text}\n{outcome.stdout}")


def main():
    session = Session()
    try:
        for readme in commands.readmes(SOURCES):
            if ONLY and not any(each in readme.path for each in ONLY):
                continue
            begins = re.match(r"(\S*flexneck) run -o out\b", (readme.commands or [""])[0])
            folder = session.folder_for(readme, with_run=not begins)
            for command in readme.commands:
                session.command(command, folder)
            for text in readme.python if (BUILD / "python").exists() else []:
                session.python(text, folder)
        if not ONLY:
            session.problems += [f"no README has a command like {each}: take it off the list"
                                 for each in set(LEFT_OUT) - session.used]
        print(f"{session.count} commands, {len(session.problems)} problems")
        print("\n".join(session.problems))
        return bool(session.problems)
    finally:
        shutil.rmtree(session.top)


if __name__ == "__main__":
    sys.exit(main())
