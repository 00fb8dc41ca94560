# SPDX-License-Identifier: GPL-3.0-or-later
"""A model that is built in code: a simple pendulum, its period beside the elliptic integral.

    python3 model_in_code.py
"""

import math

import numpy as np

import flexneck as fn

LENGTH, ANGLE, GRAVITY = 0.5, 1.2, 9.80665

model = fn.Model({
    "solver": {"end_time": "4 s", "gravity": ["0 gn", "0 gn", "-1 gn"],
               "relative_tolerance": 1e-10, "absolute_tolerance": 1e-12},
    "output": {"interval": "1 ms"},
    "body": [{"name": "ground", "kind": "ground"},
             {"name": "bob", "kind": "rigid", "mass": "2 kg",
              "center": ["0 m", "0 m", f"{-LENGTH} m"],
              "inertia": ["0 kg*m^2", "0 kg*m^2", "0 kg*m^2"]}],
    "marker": [{"body": "ground", "name": "pivot", "position": ["0 m", "0 m", "0 m"]},
               {"body": "bob", "name": "pivot", "position": ["0 m", "0 m", "0 m"]}],
    "joint": [{"name": "pin", "kind": "revolute", "lower": "ground.pivot", "upper": "bob.pivot",
               "axis": [0, 1, 0], "angle": f"{ANGLE} rad"}],
    "channel": [{"name": "swing", "quantity": "angle", "marker": "bob.pivot", "axis": [0, 1, 0]}],
})
run = model.simulate()

# Downward zero crossings are a period apart.
angle = run["swing"].values
falls = np.flatnonzero((angle[:-1] > 0) & (angle[1:] <= 0))
times = run.time[falls] + np.diff(run.time)[falls] * angle[falls] / (angle[falls] - angle[falls + 1])
period = float(np.diff(times).mean())

# Exact period 4 K(sin(ANGLE / 2)) sqrt(LENGTH / GRAVITY), K by the arithmetic-geometric mean.
a, b = 1.0, math.cos(ANGLE / 2)
while abs(a - b) > 1e-15:
    a, b = (a + b) / 2, math.sqrt(a * b)
exact = 2 * math.pi / a * math.sqrt(LENGTH / GRAVITY)
print(f"period {period:.9f} s, by the elliptic integral {exact:.9f} s")
assert abs(period / exact - 1) < 1e-7

total = sum(run.energy[part] for part in ("kinetic", "gravitational"))
print(f"energy drifts by {np.ptp(total):.1e} J")
