#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a program of somebody else's finds in the files of a run: the unit of every dataset, and the order and
signs of its numbers, against closed forms. Nothing here comes from the code that writes the files.

Usage: datasets_test.py FLEXNECK      (77: skipped, for want of h5py)
"""

import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

try:
    import h5py
    import numpy as np

    from dataset_units import UNITS
except ImportError as error:
    print(f"SKIPPED: {error}; install python3-h5py")
    sys.exit(77)

ROOT = Path(__file__).resolve().parents[3]
G = 9.80665
# The bar of tests/golden/files/bar.toml lies along x.
LENGTH, WIDTH, HEIGHT, YOUNG, DENSITY = 0.5, 0.03, 0.02, 70e9, 2700
MASS = DENSITY * LENGTH * WIDTH * HEIGHT
MESHED = 1e-8  # gmsh places nodes on surfaces to ten digits
BEAM = 1e-2  # a beam's theory: the bar is 17 and 25 times as long as it is wide
WEIGHT, WEIGHT_ARM, WEIGHT_INERTIA = 0.5, 0.02, (2e-4, 3e-4, 3e-4)  # its body at the tip

# A block 0.5 m from the axis of a table that rotates at 2 rad/s, its centre of mass 0.1 m further
# out and 0.2 m up.
SPIN, OUT, FURTHER, UP, BLOCK = 2, 0.5, 0.1, 0.2, 3
BLOCK_INERTIA = 0.04
QUANTITIES = {
    "marker": ["position", "velocity", "acceleration", "rotation_vector", "quaternion", "angular_velocity",
               "angular_acceleration", "accelerometer"],
    "joint": ["force", "moment", "load_cell_force", "load_cell_moment"],
}
TABLE = f"""
[solver]
end_time = "0.5 s"
gravity = ["0 gn", "0 gn", "-1 gn"]
[output]
interval = "0.1 s"
[[body]]
name = "table"
kind = "prescribed"
[body.turn]
axis = [0, 0, 1]
initial_rate = "{SPIN} rad/s"
[[body]]
name = "block"
kind = "rigid"
mass = "{BLOCK} kg"
center = ["{FURTHER} m", "0 m", "{UP} m"]
inertia = ["{BLOCK_INERTIA} kg*m^2", "{BLOCK_INERTIA} kg*m^2", "{BLOCK_INERTIA} kg*m^2"]
[[marker]]
body = "table"
name = "seat"
position = ["{OUT} m", "0 m", "0 m"]
[[marker]]
body = "block"
name = "foot"
position = ["0 m", "0 m", "0 m"]
[[joint]]
name = "clamp"
kind = "fixed"
lower = "table.seat"
upper = "block.foot"
""" + "".join(f"""
[[channel]]
name = "{quantity}"
quantity = "{quantity}"
{of} = "{'block.foot' if of == 'marker' else 'clamp'}"
""" for of, quantities in QUANTITIES.items() for quantity in quantities)


def text(attribute):
    """h5py reads texts of fixed length as bytes."""
    return attribute.decode() if isinstance(attribute, bytes) else attribute


def datasets(file):
    found = {}
    file.visititems(lambda name, item: found.__setitem__(name, item)
                    if isinstance(item, h5py.Dataset) else None)
    return found


def text(value):
    """Of variable or of fixed length."""
    return value.decode() if isinstance(value, bytes) else value


def skew(v):
    return np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])


class Datasets(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        # Paths that the files contain stay valid: the folder lies as deep as before.
        cls.files = cls.folder / "tests/golden/files"
        shutil.copytree(ROOT / "tests/golden/files", cls.files)
        shutil.copytree(ROOT / "geometry/examples", cls.folder / "geometry/examples")
        (cls.files / "table.toml").write_text(TABLE)
        # Without lateral contraction a bar is a beam up to its clamp.
        cls.flexneck("run", "bar.toml", "-o", "bar", "--set", "geometry.constants.along=8", "--set",
                     "geometry.materials.aluminium.poissons_ratio=0")
        cls.flexneck("simulate", "swing.toml", "-o", "bar", "--set", "body.bar.modes_file=bar/modes.h5",
                     "--set", "output.interval=0.1 ms")
        cls.flexneck("simulate", "table.toml", "-o", "bar")

    @classmethod
    def flexneck(cls, *words):
        done = subprocess.run([FLEXNECK, *words, "-q"], check=False, capture_output=True, text=True,
                              cwd=cls.files)
        if done.returncode != 0:
            raise RuntimeError(done.stdout + done.stderr)

    def open(self, name):
        file = h5py.File(self.files / name)
        self.addCleanup(file.close)
        return file

    def assert_close(self, found, expected, tolerance):
        """Relative to the largest of what is expected."""
        scale = max(np.abs(expected).max(), 1e-300)
        np.testing.assert_allclose(found, expected, rtol=0, atol=tolerance * scale)

    def check_units(self, path, table):
        file = self.open(path)
        self.assertEqual(text(file.attrs["units"]), "SI")
        used = set()
        for name, dataset in datasets(file).items():
            if name.startswith("provenance/"):
                continue
            patterns = [pattern for pattern in table if re.fullmatch(pattern, name)]
            self.assertEqual(len(patterns), 1, f"{path}: {name}")
            used |= set(patterns)
            unit = text(dataset.attrs.get("units"))
            self.assertEqual(unit, table[patterns[0]], f"{path}: {name}")
            self.assertEqual(unit is not None, dataset.dtype.kind == "f", f"{path}: {name}")
        return used

    def test_every_dataset_has_its_unit(self):
        self.flexneck("mesh", "-o", "slit", "--set", "geometry.slits=open", "--set",
                      "geometry.slit_depth=0.5", "--set", "mesh.quadrant=2", "--set", "mesh.inner_ring=2",
                      "--set", "mesh.outer_ring=1", "--set", "mesh.rubber_layers=2", "--set",
                      "geometry.bolt_patch_radius=0.4 in")
        for name, table in UNITS.items():
            used = self.check_units(f"bar/{name}", table)
            if name == "mesh.h5":
                used |= self.check_units(f"slit/{name}", table)
            self.assertEqual(set(table) - used, set(), f"{name}: nothing there has this name")

    def test_a_hexahedron_has_its_edges_where_gmsh_has_them(self):
        file = self.open("bar/mesh.h5")
        edges = [(0, 1), (0, 3), (0, 4), (1, 2), (1, 5), (2, 3),
                 (2, 6), (3, 7), (4, 5), (4, 7), (5, 6), (6, 7)]
        for element in file["nodes"][:][file["blocks/bar/hex20"][:]]:
            self.assert_close(element[8:], [(element[i] + element[j]) / 2 for i, j in edges], 1e-12)
            x, y, z = element[1] - element[0], element[3] - element[0], element[4] - element[0]
            self.assertGreater(np.dot(np.cross(x, y), z), 0)
        for name, outwards in (("clamp", -1), ("tip", 1)):
            for face in file["nodes"][:][file[f"face_sets/{name}/quad8"][:]]:
                normal = np.cross(face[1] - face[0], face[3] - face[0])
                self.assert_close(normal, [outwards * WIDTH * HEIGHT, 0, 0], MESHED)

    def test_invariants_are_those_of_a_bar_and_fit_together(self):
        file = self.open("bar/modes.h5")
        of = {name: item[:] for name, item in file["invariants"].items()}
        self.assert_close(of["mass"], [MASS], MESHED)
        self.assert_close(of["S1"], [MASS * LENGTH / 2, 0, 0], MESHED)
        across = MASS * (LENGTH**2 / 3 + np.array([HEIGHT, WIDTH])**2 / 12)
        self.assert_close(of["J0"], np.diag([MASS * (WIDTH**2 + HEIGHT**2) / 12, *across]), MESHED)
        # -~a ~b = (a . b) 1 - b a^T: its antisymmetric part is -~(a x b).
        for G0, N0 in zip(of["G0"], of["N0"].T):
            self.assert_close(G0 - G0.T, -skew(N0), 1e-9)
        for j, l in np.ndindex(of["Maa"].shape):
            G, N = of["G"][j, l], of["N"][j, l]
            np.testing.assert_allclose(G - G.T, -skew(N), rtol=0, atol=1e-9)
            self.assertAlmostEqual(np.trace(G), 2 * (j == l), delta=1e-9)
        # A bending mode moves the whole bar to the side of its tip.
        tip = file["interfaces/tip/translation"][:]
        at_tip = np.isclose(file["nodes"][:, 0], LENGTH)
        for k, mode in enumerate(file["shapes"][:2]):
            side = np.argmax(np.abs(tip[:, k]))
            self.assert_close(mode[at_tip].mean(axis=0), tip[:, k], 1e-2)
            # Clamped and free: the mean of the shape is 0.3915 of the tip's.
            self.assert_close(of["S2"][side, k], MASS * 0.3915 * tip[side, k], BEAM)
            # The shape's first moment is 0.2844 of the tip's times the length.
            moment = MASS * LENGTH * 0.2844 * np.cross([1, 0, 0], tip[:, k])
            self.assert_close(of["N0"][:, k], moment, BEAM)
            # 1.8751^2 / 2 pi L^2 sqrt(EI / rho A): the more flexible direction first.
            radius = (HEIGHT, WIDTH)[k] / np.sqrt(12)
            self.assert_close(file["frequencies"][k],
                              1.8751**2 / (2 * np.pi * LENGTH**2) * np.sqrt(YOUNG / DENSITY) * radius, BEAM)
            self.assertEqual(side, (2, 1)[k])

    def test_the_tip_gives_way_as_a_beam_and_carries_its_weight(self):
        file = self.open("bar/modes.h5")
        compliance = file["interfaces/tip/compliance"][:]
        EI_y, EI_z = (YOUNG * b * h**3 / 12 for b, h in ((WIDTH, HEIGHT), (HEIGHT, WIDTH)))
        expected = np.zeros((6, 6))
        expected[0, 0] = LENGTH / (YOUNG * WIDTH * HEIGHT)
        for along, about, EI, sign in ((1, 5, EI_z, 1), (2, 4, EI_y, -1)):
            expected[along, along] = LENGTH**3 / (3 * EI)
            expected[along, about] = expected[about, along] = sign * LENGTH**2 / (2 * EI)
            expected[about, about] = LENGTH / EI
        expected[3, 3] = compliance[3, 3]  # twist: no short closed form
        for rows in (slice(3), slice(3, 6)):
            for columns in (slice(3), slice(3, 6)):
                self.assert_close(compliance[rows, columns], expected[rows, columns], BEAM)
        arm = -WEIGHT * skew([WEIGHT_ARM, 0, 0])
        inertia = np.diag(WEIGHT_INERTIA) + WEIGHT * WEIGHT_ARM**2 * np.diag([0, 1, 1])
        self.assert_close(file["attached/weight/mass_matrix"][:],
                          np.block([[WEIGHT * np.eye(3), arm], [arm.T, inertia]]), 1e-12)

    def test_a_bar_that_is_drawn_along_is_pressed_and_one_that_spins_is_pulled(self):
        file = self.open("bar/modes.h5")["geometric_stiffness"]
        bending = lambda matrices: np.array([np.diag(each)[:2] for each in matrices])
        pushed = bending(file["acceleration"][:])
        self.assertTrue((pushed[0] < 0).all())
        self.assertLess(np.abs(pushed[1:]).max(), 1e-6 * np.abs(pushed[0]).max())
        pulled = bending(file["velocity_products"][:])
        # Rotation about its own axis does not stiffen it; about the others it does by Southwell's
        # coefficient.
        self.assert_close(pulled[1:3], 1.193 * np.ones((2, 2)), BEAM)
        self.assertLess(np.abs(pulled[[0, 3, 4, 5]]).max(), 0.01)
        force = bending(file["interfaces/tip/force"][:])
        self.assertTrue((force[0] > 0).all())
        self.assertLess(np.abs(force[1:]).max(), 1e-6 * force[0].max())

    def test_energies_go_by_their_names(self):
        file = self.open("bar/swing.h5")
        energy = {name: item[:] for name, item in file["energy"].items()}
        time = file["time"][:]
        summed = lambda rate: np.concatenate(([0], np.cumsum((rate[1:] + rate[:-1]) / 2 * np.diff(time))))
        self.assertEqual(energy["kinetic"][0], 0)  # at rest, bent by the weight
        modes = self.open("bar/modes.h5")
        names = [text(name) for name in modes["mode_names"][:]]
        chosen = [names.index(text(name)) for name in file["modal/bar/modes"][:]]
        omega = 2 * np.pi * modes["frequencies"][:][chosen]
        amplitudes = file["modal/bar/coordinates"][:]
        scale = energy["strain"].max()
        close = lambda name, expected, tolerance: np.testing.assert_allclose(
            energy[name], expected, rtol=0, atol=tolerance * scale, err_msg=name)
        close("strain", (omega**2 * amplitudes**2).sum(axis=1) / 2, 1e-2)
        rates = np.gradient(amplitudes, time, axis=0)
        close("dissipated", summed((2 * 0.05 * omega * rates**2).sum(axis=1)), 1e-2)
        push = np.interp(time, [0, 3e-3, 6e-3], [0, 50, 0])
        close("work", summed(push * file["markers/weight.bolt/velocity"][:, 1]), 1e-3)
        bolt, rise = (file["markers/weight.bolt/position"][:, 2], energy["gravitational"])
        self.assertGreater(np.corrcoef(bolt, rise)[0, 1], 0.99)
        balance = sum(energy[name] for name in ("kinetic", "gravitational", "strain", "dissipated"))
        np.testing.assert_allclose(balance - energy["work"], balance[0], rtol=0, atol=1e-6 * scale)

    def test_a_block_on_a_turning_table(self):
        file = self.open("bar/table.h5")
        time = file["time"][:]
        one, zero = np.ones_like(time), np.zeros_like(time)
        cos, sin = np.cos(SPIN * time), np.sin(SPIN * time)
        half = SPIN * time / 2
        inwards = -BLOCK * SPIN**2 * (OUT + FURTHER)
        about_y = UP * inwards - FURTHER * BLOCK * G
        columns = {
            "position": (OUT * cos, OUT * sin, zero),
            "velocity": (-OUT * SPIN * sin, OUT * SPIN * cos, zero),
            "acceleration": (-OUT * SPIN**2 * cos, -OUT * SPIN**2 * sin, zero),
            "rotation_vector": (zero, zero, SPIN * time),
            "quaternion": (np.cos(half), zero, zero, np.sin(half)),
            "angular_velocity": (zero, zero, SPIN * one),
            "angular_acceleration": (zero, zero, zero),
            "accelerometer": (-OUT * SPIN**2 * one, zero, G * one),
            "force": (inwards * one, zero, BLOCK * G * one),
            "moment": (zero, about_y * one, zero),
            "load_cell_force": (inwards * one, zero, -BLOCK * G * one),
            "load_cell_moment": (zero, -about_y * one, zero),
        }
        units = ["m", "m/s", "m/s^2", "rad", "1", "rad/s", "rad/s^2", "m/s^2", "N", "N m", "N", "N m"]
        recorded = {name: f"markers/block.foot/{name}" for name in (
            "position", "velocity", "acceleration", "angular_velocity", "angular_acceleration")}
        recorded |= {"quaternion": "markers/block.foot/rotation", "force": "joints/clamp/force",
                     "moment": "joints/clamp/moment"}
        for (name, expected), unit in zip(columns.items(), units, strict=True):
            expected = np.column_stack(expected)
            with self.subTest(name):
                self.assertEqual(text(file[f"channels/{name}/values"].attrs["units"]), unit)
                np.testing.assert_allclose(file[f"channels/{name}/values"][:], expected, rtol=0, atol=1e-6)
                if name in recorded:
                    np.testing.assert_allclose(file[recorded[name]][:], expected, rtol=0, atol=1e-6)
        kinetic = (BLOCK * (OUT + FURTHER)**2 + BLOCK_INERTIA) * SPIN**2 / 2
        for name, value in (("kinetic", kinetic), ("gravitational", BLOCK * G * UP), ("strain", 0),
                            ("dissipated", 0), ("work", 0)):
            np.testing.assert_allclose(file[f"energy/{name}"][:], value, rtol=0, atol=1e-6, err_msg=name)
        self.check_text(columns, units, time)

    def check_text(self, columns, units, time):
        header, *rows = (self.files / "bar/table.csv").read_text().splitlines()
        letters = {"quaternion": "wxyz", "load_cell_force": ("Fx", "Fy", "Fz"),
                   "load_cell_moment": ("Mx", "My", "Mz")}
        titles = [f"{name} {letter} [{unit}]" for name, unit in zip(columns, units)
                  for letter in letters.get(name, "xyz")]
        self.assertEqual(header.split(",")[1:], titles)
        numbers = np.array([[float(cell) for cell in row.split(",")] for row in rows])
        expected = [time, *(column for each in columns.values() for column in each)]
        np.testing.assert_allclose(numbers, np.column_stack(expected), rtol=0, atol=1e-6)


if __name__ == "__main__":
    FLEXNECK = str(Path(sys.argv.pop(1)).resolve())
    unittest.main(verbosity=2)
