# SPDX-License-Identifier: GPL-3.0-or-later
"""The flexible slider-crank of the test set for initial value problem solvers (Simeon; problem `crank`): a modal
body built from the published matrices, started with the published modal coordinates, compared with the
published state at 0.1 s.

    python3 slider_crank.py [FOLDER]
"""

import pathlib
import sys

import numpy as np

import flexneck as fn

out = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "out")
out.mkdir(parents=True, exist_ok=True)

# The published problem: SI units, two transverse and two longitudinal modes of the connecting rod.
PI = 3.1415927
CRANK, ROD, SPEED = 0.15, 0.30, 150.0
ROD_MASS, ROD_INERTIA, SLIDER_MASS = 0.151104, 0.0045339259, 0.075552
WIDTH, MODULUS, DENSITY = 0.008, 2e11, 7870.0
START = {"q": [0, 0, 1.03339863e-5, 1.69327969e-5], "x": 0.450016933, "angle rate": -74.9957670,
         "q rate": [0.444896105, 4.63434311e-3, -1.78591076e-6, -2.68938672e-6], "x rate": -2.68938672e-6}
END = {"angle": -0.3311734987910881, "x": 0.1697373326718410, "x rate": -8.753116989887888,
       "angle rate": 60.25346682645789,
       "q": [1.893192460247178e-4, 2.375751865617931e-5, -5.323907988763734e-6, -8.363283141616840e-6]}

volume = WIDTH * WIDTH * ROD
weight, spring = DENSITY * volume, MODULUS * WIDTH**2 / ROD
bend = spring * PI**4 * (WIDTH / ROD) ** 2
M = weight * np.array([[0.5, 0, 0, 0], [0, 0.5, 0, 0], [0, 0, 8, 1], [0, 0, 1, 2]])
K = np.diag([bend / 24, bend * 2 / 3, 0, 0])
K[2:, 2:] = spring * np.array([[16, -8], [-8, 7]]) / 3

# Mass integrals of the modes, as published: of themselves along x and y, by pairs, by place.
S2 = weight * np.array([[0, 2 / PI, 0], [0, 0, 0], [2 / 3, 0, 0], [1 / 6, 0, 0]])
B = np.zeros((4, 4))
B[0, 2], B[0, 3], B[1, 3] = -16 / PI**3, 8 / PI**3 - 1 / PI, 1 / (2 * PI)
B = weight * (B - B.T)
pairs = np.zeros((4, 4, 3, 3))  # int rho psi_j psi_l^T
pairs[:2, :2, 1, 1], pairs[2:, 2:, 0, 0] = M[:2, :2], M[2:, 2:]
pairs[:2, 2:, 1, 0], pairs[2:, :2, 0, 1] = -B[:2, 2:], B[2:, :2]
placed = np.zeros((4, 3, 3))  # int rho psi_l s0^T, s0 along x
placed[:, 0, 0] = weight * ROD * np.array([0, 0, 1 / 3, 1 / 6])
placed[:, 1, 0] = weight * ROD * np.array([1 / PI, -1 / (2 * PI), 0, 0])

# Mass-normalised modes: K T = M T diag(omega^2), T^T M T = 1.
root = np.linalg.inv(np.linalg.cholesky(M))
squares, vectors = np.linalg.eigh(root @ K @ root.T)
T = root.T @ vectors
pairs = np.einsum("jl...,ja,lb->ab...", pairs, T, T)
placed = np.einsum("l...,la->a...", placed, T)


def inertia(moments):
    """-~p ~q = (p . q) 1 - q p^T of moments [..., q, p]."""
    return np.trace(moments, axis1=-2, axis2=-1)[..., None, None] * np.eye(3) - moments


at_end = np.zeros((4, 3))
at_end[:, 0] = T[3]  # the rod's end moves along x with the fourth mode
across = ROD_MASS * WIDTH**2 / 6
rod = fn.ModalBody.build(
    out / "rod.h5", names=[f"mode {k}" for k in range(1, 5)],
    frequencies=np.sqrt(squares) / (2 * np.pi),
    nodes=[[0, 0, 0], [ROD, 0, 0]], shapes=np.stack([np.zeros((4, 3)), at_end], axis=1),
    interfaces={"start": fn.Interface(np.zeros(3), np.zeros((4, 3)), np.zeros((4, 3))),
                "end": fn.Interface(np.array([ROD, 0, 0]), at_end, np.zeros((4, 3)))},
    invariants={
        "mass": ROD_MASS, "S1": [ROD_MASS * ROD / 2, 0, 0], "S2": T.T @ S2,
        "J0": np.diag([across, ROD_INERTIA, ROD_INERTIA]), "G0": inertia(placed),
        "G": inertia(np.swapaxes(pairs, -2, -1)), "Maa": np.eye(4),
        "N0": np.stack([placed[:, 2, 1] - placed[:, 1, 2], placed[:, 0, 2] - placed[:, 2, 0],
                        placed[:, 1, 0] - placed[:, 0, 1]], axis=-1),
        "N": np.stack([pairs[..., 1, 2] - pairs[..., 2, 1], pairs[..., 2, 0] - pairs[..., 0, 2],
                       pairs[..., 0, 1] - pairs[..., 1, 0]], axis=-1)})

ORIGIN = ["0 m", "0 m", "0 m"]
model = fn.Model({
    "solver": {"end_time": "0.1 s", "relative_tolerance": 1e-10, "absolute_tolerance": 1e-13},
    "output": {"interval": "1 ms"},
    "body": [
        {"name": "ground", "kind": "ground"},
        {"name": "crank", "kind": "prescribed",
         "turn": {"axis": [0, 0, 1], "initial_rate": f"{SPEED} rad/s"}},
        {"name": "rod", "kind": "deformable", "modes_file": "rod.h5", "damping_ratio": 0,
         "position": [f"{CRANK} m", "0 m", "0 m"],
         "velocity": ["0 m/s", f"{CRANK * SPEED} m/s", "0 m/s"],
         "angular_velocity": ["0 rad/s", "0 rad/s", f"{START['angle rate']} rad/s"],
         "modal_coordinates": T.T @ M @ START["q"], "modal_rates": T.T @ M @ START["q rate"]},
        {"name": "slider", "kind": "rigid", "mass": f"{SLIDER_MASS} kg", "center": ORIGIN,
         "inertia": ["0 kg*m^2", "0 kg*m^2", "0 kg*m^2"], "position": [f"{START['x']} m", "0 m", "0 m"],
         "velocity": [f"{START['x rate']} m/s", "0 m/s", "0 m/s"]}],
    "marker": [{"body": "ground", "name": "guide", "position": ORIGIN},
               {"body": "crank", "name": "pin", "position": [f"{CRANK} m", "0 m", "0 m"]},
               {"body": "slider", "name": "pin", "position": ORIGIN}],
    "joint": [{"name": "crank pin", "kind": "revolute", "lower": "crank.pin", "upper": "rod.start",
               "axis": [0, 0, 1]},
              {"name": "piston pin", "kind": "spherical", "lower": "rod.end", "upper": "slider.pin"},
              {"name": "guide", "kind": "prismatic", "lower": "ground.guide", "upper": "slider.pin",
               "axis": [1, 0, 0]}],
}, folder=out, name="slider_crank")
run = model.simulate()

w, _, _, z = run.markers["rod.start"].rotation[-1]
slider = run.markers["slider.pin"]
found = {"angle": np.remainder(2 * np.arctan2(z, w) + np.pi, 2 * np.pi) - np.pi,
         "x": slider.position[-1, 0], "x rate": slider.velocity[-1, 0],
         "angle rate": run.markers["rod.start"].angular_velocity[-1, 2]}
for name, value in found.items():
    error = abs(value / END[name] - 1)
    print(f"{name:10} {value:+.12f}, published {END[name]:+.12f}: {error:.1e}")
    assert error < 1e-6, name
q = T @ run.modal["rod"][-1]
error = np.abs(q - END["q"]).max() / np.abs(END["q"]).max()
print(f"modal coordinates: {error:.1e} of the largest")
assert error < 1e-6
