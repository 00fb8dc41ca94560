# SPDX-License-Identifier: GPL-3.0-or-later
"""Commands to be disturbed, each with a folder that holds what it reads and older results, and how it
ends undisturbed."""

import dataclasses
import hashlib
import os
import resource
import shutil
import signal
import subprocess
import time

import sound_files

COARSE = [word for value in sound_files.COARSE for word in ("--set", value)]
OTHER = ["--set", "geometry.plate_thickness=0.42 in"]
MEASURED = ("timing.json", "stages.json", "report.html")  # by a run, directly or as a hash
LOCK = "out/.flexneck.lock"
SHORTER = ["--set", "solver.end_time=10 ms"]
SECONDS = 120  # on the clock, for a machine with other work


@dataclasses.dataclass
class Scenario:
    """A command in a folder of its own. Results are in out/, temporary files go to tmp/."""

    name: str
    arguments: list
    folder: str  # to be copied, never changed
    before: dict = dataclasses.field(default_factory=dict)  # hash of each file
    after: dict = dataclasses.field(default_factory=dict)  # the same, undisturbed
    measured: tuple = ()
    text: str = ""  # undisturbed
    seconds: float = 0.0

    def hashes(self, work):
        return hashes(work, self.measured)


@dataclasses.dataclass
class End:
    """How a command ended."""

    status: object  # exit code, minus the number of a signal, or "hang"
    text: str

    def is_one_line(self, scenario):
        """Whether it tells one thing more than undisturbed, where a verification may fail."""
        usual = scenario.text.splitlines()
        lines = [line for line in self.text.splitlines()
                 if not line.startswith(("Warning: ", "Fontconfig ")) and line not in usual]
        return len(lines) == 1 and lines[0].startswith("flexneck: ")


def hashes(folder, measured=()):
    """Every file and folder in a folder, with the hash of what a file holds.
    @param measured  files that hold measured times: only whether they are whole"""
    found = {}
    for place, folders, files in os.walk(folder):
        for name in folders:
            found[os.path.relpath(os.path.join(place, name), folder) + "/"] = ""
        for name in files:
            path = os.path.join(place, name)
            with open(path, "rb") as file:
                contents = file.read()
            is_whole = name in measured and contents.endswith((b"}\n", b"</html>\n"))
            found[os.path.relpath(path, folder)] = \
                "whole" if is_whole else hashlib.sha256(contents).hexdigest()
    return found


def environment(folder, more=()):
    return {**os.environ, "TMPDIR": os.path.join(folder, "tmp"), "OMP_NUM_THREADS": "1",
            **dict(more)}


def start(program, arguments, folder, variables=(), prepare=None, text=subprocess.PIPE):
    def before_exec():
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        if prepare:
            prepare()

    return subprocess.Popen([program, *arguments, "-q"], cwd=folder, stdout=text,
                            stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL,
                            env=environment(folder, variables), preexec_fn=before_exec,
                            start_new_session=True)


def end_of(process):
    try:
        text, _ = process.communicate(timeout=SECONDS)
        return End(process.returncode, text.decode("utf-8", "replace"))
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        text, _ = process.communicate()
        return End("hang", text.decode("utf-8", "replace"))


def run(program, arguments, folder, variables=(), prepare=None):
    return end_of(start(program, arguments, folder, variables, prepare))


def copy(scenario, folder):
    """A fresh copy of the folder that the command runs in. @return its hashes"""
    shutil.copytree(scenario.folder, folder)
    return scenario.before


def differences(found, expected):
    """Names whose contents are not one of those expected, or that should or should not be there.
    @param expected  a set of hashes for each name; None among them: the file may be missing"""
    return sorted(name for name in found.keys() | expected.keys()
                  if found.get(name) not in expected.get(name, {None}))


def either(scenario):
    """Each file as before or as an undisturbed run leaves it."""
    return {name: {scenario.before.get(name), scenario.after.get(name)}
            for name in scenario.before.keys() | scenario.after.keys()}


def left_by_a_crash(name):
    """A process that a signal kills at once, or that crashes, cannot remove its lock, which the system releases,
    its temporary folder, or the hidden folder of an export: a later command does."""
    return name == LOCK or name.startswith(("tmp/flexneck-", "out/.flexneck-"))


def exactly(hashes_of_files):
    return {name: {value} for name, value in hashes_of_files.items()}


def _must(program, arguments, folder):
    end = run(program, arguments, folder)
    if end.status not in (0, 1):
        raise SystemExit(f"{' '.join(arguments)} in {folder}: {end.status} {end.text}")
    return end.text


def _verify(program, folder):
    """Every file of ours holds the hash of its content."""
    paths = [name for name in hashes(folder)
             if name.endswith(".h5") and "/" in name and not name.endswith("_view.h5")]
    end = run(program, ["info", *paths], folder)
    if end.status != 0 or "not verified" in end.text:
        raise SystemExit(f"{folder}: {end.text}")


def _finish(program, name, arguments, folder, base):
    """Runs the command undisturbed, twice: results have to be the same to be compared."""
    os.makedirs(os.path.join(folder, "tmp"), exist_ok=True)
    measured = MEASURED if folder.endswith("older-neck") else ()
    scenario = Scenario(name, arguments, folder, hashes(folder, measured), measured=measured)
    for attempt in range(2):
        work = os.path.join(base, f"{name}-undisturbed-{attempt}".replace(" ", "-"))
        copy(scenario, work)
        begin = time.monotonic()
        scenario.text = _must(program, arguments, work)
        scenario.seconds = time.monotonic() - begin
        found = scenario.hashes(work)
        if attempt == 1 and found != scenario.after:
            raise SystemExit(f"{name}: two runs differ in {differences(found, exactly(scenario.after))}")
        scenario.after = found
    _verify(program, work)
    shutil.rmtree(work)
    return scenario


class Folders:
    """Folders of results to begin with, made when first asked for."""

    def __init__(self, program, base):
        self.program = program
        self.base = base

    def _path(self, kind):
        path = os.path.join(self.base, kind)
        return path, os.path.isdir(path)

    def bar(self):
        """A bar of two elements from gmsh, with results of other values."""
        path, is_made = self._path("bar")
        if not is_made:
            sound_files.make(self.program, path)
            os.makedirs(os.path.join(path, "tmp"))
            _must(self.program, ["run", "msh4.toml", "--set", "modes.count=2"], path)
            _must(self.program, ["simulate", "model.toml", *SHORTER], path)
        return path

    def older_neck(self):
        """The coarsest neck with another plate."""
        path, is_made = self._path("older-neck")
        if not is_made:
            os.makedirs(os.path.join(path, "tmp"))
            _must(self.program, ["run", *COARSE, *OTHER], path)
        return path

    def neck(self):
        """The coarsest neck, save older ones of what is made last."""
        path, is_made = self._path("neck")
        if not is_made:
            shutil.copytree(self.older_neck(), path)
            _must(self.program, ["run", *COARSE], path)
            for name in ("report.html", "mesh.png", "verification.json"):
                with open(os.path.join(path, "out", name), "wb") as file:
                    file.write(b"an older one\n")
        return path


def make(program, base, wanted=""):
    """Makes the scenarios whose names begin with one of `wanted`, comma between."""
    folders = Folders(program, base)
    commands = [
        ("mesh", folders.bar, ["mesh", "msh4.toml"]),
        ("modes", folders.bar, ["modes", "msh4.toml"]),
        ("simulate", folders.bar, ["simulate", "model.toml"]),
        ("export", folders.bar, ["export", "msh4.toml", "--to", "out/bar.inp"]),
        ("mme", folders.bar, ["export", "out/model.h5", "--to", "out/lab/lab.mme"]),
        ("neck-mesh", folders.older_neck, ["mesh", *COARSE]),
        ("neck-modes", folders.neck, ["modes", *COARSE, "--set", "modes.count=5"]),
        ("neck-report", folders.neck, ["report", *COARSE]),
        ("neck-pictures", folders.neck, ["pictures", *COARSE]),
        ("neck-run", folders.older_neck, ["run", *COARSE]),
    ]
    prefixes = tuple(wanted.split(","))
    return [_finish(program, name, arguments, folder(), base)
            for name, folder, arguments in commands if name.startswith(prefixes)]
