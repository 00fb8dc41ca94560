# SPDX-License-Identifier: GPL-3.0-or-later
"""A sweep and a rating: how the thickness of the plates moves the first frequencies, and how well a
neck with thicker plates follows the standard one on the pendulum.

    python3 parameter_study.py [FOLDER]
"""

import pathlib
import sys

import numpy as np

import flexneck as fn

out = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "out")
out.mkdir(parents=True, exist_ok=True)

(out / "thickness.toml").write_text("""
include = ["hybrid3"]

[sweep]
plan = "grid"
outputs = ["modes.frequency_by_rank.bending 1", "modes.mass"]

[[sweep.parameter]]
key = "geometry.plate_thickness"
unit = "in"
values = [0.35, 0.4]
""")
swept = fn.Study(out / "thickness.toml").sweep(out / "sweep")
print((swept.folder / "sweep.csv").read_text())

curves = []
for thickness in ("0.35 in", "0.4 in"):
    run = fn.Study("hybrid3").set("geometry.plate_thickness", thickness).mesh().modes().pendulum(
        "flexion-60")
    times = np.arange(0, run.time[-1], 1e-4)  # 10 kHz
    curves.append(np.interp(times, run.time, run["head rotation"]))
rating = fn.iso18571(*curves)
print("ISO/TS 18571:", ", ".join(f"{name} {value:.3f}" for name, value in rating.items()))
