# SPDX-License-Identifier: GPL-3.0-or-later
"""One small sound file of each format that flexneck reads, made by the program itself, and the
commands that read it."""

import dataclasses
import os
import shutil
import subprocess

MATERIAL = """
[geometry.materials.aluminium]
youngs_modulus = "70 GPa"
poissons_ratio = 0.33
density = "2700 kg/m^3"
parts = ["{part}"]

[modes]
count = 3
fixed = ["{held}"]
formulation = "displacement"

[[interface]]
name = "root"
set = "{held}"
position = ["0 mm", "0 mm", "0 mm"]

[[interface]]
name = "end"
set = "{tip}"
position = ["80 mm", "0 mm", "0 mm"]
"""

STUDY = '[geometry]\nfile = "{file}"\n{unit}' + MATERIAL

SCRIPT = """SetFactory("Built-in");
Point(1) = {{0, -10, -10}}; Point(2) = {{0, 10, -10}};
Line(1) = {{1, 2}}; Transfinite Curve {{1}} = 2;
section[] = Extrude {{0, 0, 20}} {{ Line{{1}}; Layers{{1}}; Recombine; }};
bar[] = Extrude {{80, 0, 0}} {{ Surface{{section[1]}}; Layers{{2}}; Recombine; }};
Physical Volume("bar", 1) = {{bar[1]}};
Physical Surface("clamp", 2) = {{section[1]}};
Physical Surface("tip", 3) = {{bar[0]}};
Mesh.ElementOrder = 2; Mesh.SecondOrderIncomplete = 1;
Mesh 3;
{saves}
"""

SAVES = """Mesh.MshFileVersion = 2.2; Save "text2.msh";
Mesh.MshFileVersion = 4.1; Save "text4.msh";
Mesh.Binary = 1; Save "binary4.msh"; Mesh.Binary = 0;
Save "bar.unv"; Save "bar.bdf";"""

SHAPE = """SetFactory("OpenCASCADE");
Box(1) = {0, -10, -10, 80, 20, 20}; Cylinder(2) = {20, 0, -10, 0, 0, 20, 4};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
Save "bar.step"; Save "bar.brep";
Physical Volume("bar") = {3}; Physical Surface("clamp") = {Surface{:}};
"""

MODEL = """[solver]
end_time = "20 ms"
relative_tolerance = 1e-5
gravity = ["0 gn", "0 gn", "-1 gn"]

[output]
interval = "1 ms"

[[body]]
name = "sled"
kind = "prescribed"
direction = [1, 0, 0]
table = "pulse.csv"

[[body]]
name = "bar"
kind = "deformable"
modes_file = "modes.h5"
damping_ratio = 0.1

[[body]]
name = "head"
kind = "rigid"
mass = "0.1 kg"
center = ["10 mm", "0 mm", "0 mm"]
inertia = ["1e-5 kg*m^2", "1e-5 kg*m^2", "1e-5 kg*m^2"]

[[marker]]
body = "sled"
name = "floor"
position = ["0 m", "0 m", "0 m"]

[[marker]]
body = "head"
name = "joint"
position = ["0 m", "0 m", "0 m"]

[[joint]]
name = "clamp"
kind = "fixed"
lower = "sled.floor"
upper = "bar.root"

[[joint]]
name = "ball"
kind = "ball"
lower = "bar.end"
upper = "head.joint"
"""

PULSE = "time [ms], acceleration [gn]\n0, 0\n5, 4\n10, 9\n20, 0\n"

# The coarsest neck.
COARSE = ["mesh.quadrant=2", "mesh.inner_ring=2", "mesh.outer_ring=1", "mesh.rubber_layers=1",
          "geometry.bolt_patch_radius=0.4 in", "pendulum.duration=0.2 s"]


@dataclasses.dataclass
class Format:
    """A file of some format within a folder of what it needs, and the commands that read it."""

    name: str
    file: str  # to be damaged, within the folder
    commands: list  # of argument lists; run in the folder one after another until one fails
    text: bool


def _run(program, arguments, folder):
    done = subprocess.run([program, *arguments], cwd=folder, capture_output=True, text=True)
    if done.returncode not in (0, 1):
        raise SystemExit(f"{' '.join(arguments)} in {folder}: {done.stdout}{done.stderr}")


def _write(folder, name, text):
    with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
        file.write(text)


def _make_bar(program, folder, script, part, held, tip):
    _write(folder, "maker.geo", script)
    study = '[geometry]\nscript = "maker.geo"\n' + MATERIAL.format(part=part, held=held, tip=tip)
    _write(folder, "maker.toml", study)
    # Only the file that the script saves counts; the script's own mesh need not be sound.
    subprocess.run([program, "mesh", "-q", "maker.toml", "-o", "made"], cwd=folder,
                   capture_output=True, check=False)


def _study(folder, stem, file, unit, part, held, tip):
    text = STUDY.format(file=file, unit=unit, part=part, held=held, tip=tip)
    _write(folder, stem + ".toml", text)


def make(program, folder):
    """Makes the files in `folder` and returns their formats."""
    os.makedirs(folder)
    _make_bar(program, folder, SHAPE, "bar", "clamp", "clamp")
    _make_bar(program, folder, SCRIPT.format(saves=SAVES), "bar", "clamp", "tip")
    shutil.rmtree(os.path.join(folder, "made"), ignore_errors=True)
    mm = 'unit = "mm"\n'
    names = ("bar", "clamp", "tip")
    unnamed = ("volume_1", "surface_2", "surface_3")
    of_shape = ("volume_1", "surface_1", "surface_2")
    formats = []

    def mesh(name, file, unit, sets, text=True):
        _study(folder, name, file, unit, *sets)
        formats.append(Format(name, file, [["mesh", name + ".toml"], ["info", "out/mesh.h5"]], text))

    mesh("msh2", "text2.msh", mm, names)
    mesh("msh4", "text4.msh", mm, names)
    mesh("msh4-binary", "binary4.msh", mm, names, text=False)
    mesh("unv", "bar.unv", mm, names)
    mesh("bdf", "bar.bdf", mm, unnamed)
    mesh("step", "bar.step", "", of_shape)
    mesh("brep", "bar.brep", mm, of_shape)
    _run(program, ["run", "-q", "msh4.toml"], folder)
    deck = ["export", "-q", "msh4.toml", "--to", "bar.inp"]
    _run(program, deck, folder)
    mesh("inp", "bar.inp", "", names)

    for name in ("mesh.h5", "modes.h5"):
        shutil.copy(os.path.join(folder, "out", name), folder)
    _write(folder, "model.toml", MODEL)
    _write(folder, "pulse.csv", PULSE)
    simulate = ["simulate", "model.toml"]
    _run(program, [*simulate, "-q"], folder)
    shutil.copy(os.path.join(folder, "out", "model.h5"), os.path.join(folder, "history.h5"))
    shutil.rmtree(os.path.join(folder, "out"))

    binary = {"text": False}
    formats += [
        Format("mesh.h5", "mesh.h5", [["info", "mesh.h5"], ["export", "msh4.toml", "-o", ".",
                                                          "--to", "again.msh"]], **binary),
        Format("modes.h5", "modes.h5", [["info", "modes.h5"], simulate], **binary),
        Format("history.h5", "history.h5", [["info", "history.h5"]], **binary),
        Format("study", "msh4.toml", [["mesh", "msh4.toml"], ["modes", "msh4.toml"]], True),
        Format("model", "model.toml", [simulate, ["info", "out/model.h5"]], True),
        Format("csv", "pulse.csv", [simulate], True),
    ]
    return formats


def make_results(program, folder):
    """Makes a folder of results of the coarsest neck; its files are read by verify and report."""
    os.makedirs(folder)
    settings = [word for value in COARSE for word in ("--set", value)]
    _run(program, ["run", "-q", *settings], folder)
    verify = [["verify", *settings]]
    files = ("mesh.h5", "modes.h5", "pendulum-flexion-60.h5", "static-flexion.h5", "pendulum.json")
    readers = {"mesh.h5": [["pictures", *settings]], "static-flexion.h5": [["report", *settings]],
               "pendulum.json": [["report", *settings]]}
    return [Format("results/" + name, "out/" + name, readers.get(name, verify),
                   name.endswith(".json")) for name in files]
