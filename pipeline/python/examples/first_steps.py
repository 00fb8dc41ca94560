# SPDX-License-Identifier: GPL-3.0-or-later
"""A neck with thicker plates: its modes, the pendulum, files for other programs.

    python3 first_steps.py [FOLDER]
"""

import pathlib
import sys

import flexneck as fn
from plots import Picture

out = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "out")
out.mkdir(parents=True, exist_ok=True)

study = fn.Study("hybrid3").set("geometry.plate_thickness", "0.4 in")
body = study.mesh().modes(count=10)
run = body.pendulum("flexion-120")

for name, frequency in zip(body.names, body.frequencies):
    print(f"{name:24} {frequency:8.3f} Hz")
rotation = run["head rotation"].to("deg")
print(f"head rotation: up to {rotation.max():.1f} deg at {run.time[rotation.argmax()] * 1e3:.1f} ms")

picture = Picture("time, ms", "head rotation, deg")
picture.curve(run.time * 1e3, rotation, "plates of 0.4 in")
picture.save(out / "first_steps.svg")
body.export(out / "neck.vtu")  # mesh and modes for ParaView
body.export(out / "neck.fem")  # the modal body for MBDyn
run.export(out / "run.csv")
