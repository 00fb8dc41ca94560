# SPDX-License-Identifier: GPL-3.0-or-later
"""A tour from the geometry to figures of the paper's kind: the mesh, the modes, the static test and
the pendulum.

    python3 paper_figures.py [FOLDER]
"""

import pathlib
import sys

import numpy as np

import flexneck as fn
from plots import Picture

out = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "out")
out.mkdir(parents=True, exist_ok=True)

# The geometry, and some quantities that follow from it.
study = fn.Study("hybrid3")
for key in ("geometry.plate_diameter", "geometry.plate_thickness", "geometry.length"):
    value = study.values.get(key) or study.defaults[key]
    print(f"{key:28} {value.text:12} {value.origin}")
mesh = study.mesh()
print(f"{len(mesh.nodes)} nodes, {mesh.mass * fn.factor('kg', 'lb'):.3f} lb")

section = mesh.nodes[np.abs(mesh.nodes[:, 1]) < 1e-6]
picture = Picture("x, in", "z, in")
picture.curve(section[:, 0] * fn.factor("m", "in"), section[:, 2] * fn.factor("m", "in"),
              "nodes in the plane of symmetry", ".")
picture.save(out / "mesh.svg")

# The modes: bending shape of the neck's axis in the fore-aft modes.
body = mesh.modes()
nodes = body.nodes
near = np.argsort(nodes[:, 2] + 1e3 * np.hypot(nodes[:, 0], nodes[:, 1]).round(4))
axis = near[np.hypot(nodes[near, 0], nodes[near, 1]) < np.hypot(nodes[:, 0], nodes[:, 1]).min() + 2e-3]
axis = axis[np.argsort(nodes[axis, 2])]
picture = Picture("height, in", "fore-aft shape, scaled")
for mode, frequency, shares in zip(body.names, body.frequencies, body.shares):
    if shares[0] < 50:
        continue
    shape = body.shape(mode)[axis, 0]
    picture.curve(nodes[axis, 2] * fn.factor("m", "in"), shape / np.abs(shape).max(),
                  f"{mode}, {frequency:.1f} Hz")
picture.save(out / "modes.svg")

# The static neck tester: moment at the base over rotation.
cases = study.cases
picture = Picture("rotation, deg", "moment at the base, lbf ft")
for case in (name for name, kind in cases.items() if kind == "static"):
    run = body.static(case)
    picture.curve(run["rotation"].to("deg"), run["base moment"].to("lbf*ft"), case)
picture.save(out / "static.svg")

# The pendulum: head rotation over time.
picture = Picture("time, ms", "head rotation, deg")
for case in ("flexion-60", "flexion-120", "extension-120"):
    run = body.pendulum(case)
    picture.curve(run.time * 1e3, run["head rotation"].to("deg"), case)
    moment = np.abs(run["occipital moment"].to("lbf*ft")).max()
    print(f"{case:16} moment at the condyles {moment:5.1f} lbf ft")
picture.save(out / "pendulum.svg")
