# SPDX-License-Identifier: GPL-3.0-or-later
"""A force that a function of Python gives, and the same as a formula in the model.

    python3 python_force.py
"""

import numpy as np

import flexneck as fn

STIFFNESS, MASS = 400.0, 2.0

TABLES = {
    "solver": {"end_time": "1 s", "relative_tolerance": 1e-9, "absolute_tolerance": 1e-12},
    "output": {"interval": "1 ms"},
    "body": [{"name": "ground", "kind": "ground"},
             {"name": "block", "kind": "rigid", "mass": f"{MASS} kg",
              "center": ["0 m", "0 m", "0 m"],
              "inertia": ["1e-3 kg*m^2", "1e-3 kg*m^2", "1e-3 kg*m^2"]}],
    "marker": [{"body": "ground", "name": "rail", "position": ["0 m", "0 m", "0 m"]},
               {"body": "block", "name": "center", "position": ["0 m", "0 m", "0 m"]}],
    "joint": [{"name": "slide", "kind": "prismatic", "lower": "ground.rail",
               "upper": "block.center", "axis": [1, 0, 0], "distance": "0.1 m"}],
}
ENDS = {"name": "spring", "lower": "ground.rail", "upper": "block.center"}


def spring(time, position, velocity, rotation, angular_velocity):
    """A stiffening spring with a damper, and a load over time."""
    x, v = position[0], velocity[0]
    return [-STIFFNESS * x * (1 + 50 * x * x) - 3 * v + 5 * np.sin(20 * time), 0, 0], [0, 0, 0]


by_python = fn.Model(TABLES).add_function("spring", ENDS["lower"], ENDS["upper"], spring).simulate()
formula = f"-{STIFFNESS} * x * (1 + 50 * x * x) - 3 * vx + 5 * sin(20 * t)"
by_formula = fn.Model({**TABLES, "function_force": [{**ENDS, "Fx": formula}]}).simulate()

x = by_python.markers["block.center"].position[:, 0]
off = np.abs(x - by_formula.markers["block.center"].position[:, 0]).max()
print(f"the two differ by {off:.1e} m")
assert off < 1e-9

# The energy that the force gives to the block counts as work in the energy balance.
kinetic, work = by_python.energy["kinetic"], by_python.energy["work"]
print(f"books of energy: {np.abs(kinetic - work - kinetic[0]).max():.1e} J off")
assert np.abs(kinetic - work - kinetic[0]).max() < 1e-7
