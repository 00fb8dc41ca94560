#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""mesh.h5 and modes.h5 that h5py writes from their documentation alone (pipeline/manual/reference/:
mesh_file.md, modes_file.md, files.md) do what files of the program's own do.

Usage: foreign_files_test.py FLEXNECK      (77: skipped, for want of h5py)
"""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

try:
    import h5py
    import numpy as np
except ImportError as error:
    print(f"SKIPPED: {error}; install python3-h5py")
    sys.exit(77)

TEXT = h5py.string_dtype()  # of variable length, h5py's default for strings

# A bar of four cubes along x, clamped at x = 0.
SIDE = 0.1
CELLS = 4
YOUNGS_MODULUS, POISSONS_RATIO, DENSITY = 70e9, 0.3, 2700
STUDY = f"""
[geometry]
file = "bar.msh"
[geometry.materials.metal]
youngs_modulus = "{YOUNGS_MODULUS} Pa"
poissons_ratio = {POISSONS_RATIO}
density = "{DENSITY} kg/m^3"
parts = ["bar"]
[modes]
count = 3
fixed = ["clamp"]
"""

# A massless rod along z, clamped at z = 0, with crosses of four masses on it, each mode one parabola.
CROSS = np.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0]]) * 0.05
HEIGHTS = np.repeat([0.0, 0.1, 0.2, 0.3], len(CROSS))
MASSES = np.repeat([0.0, 0.5, 0.75, 1.0], len(CROSS)) / len(CROSS)
FREQUENCIES = np.array([5.0, 8.0])
GRAVITY = 2.0
MODEL = f"""
[solver]
end_time = "0.4 s"
gravity = ["{GRAVITY} m/s^2", "0 m/s^2", "0 m/s^2"]
relative_tolerance = 1e-10
absolute_tolerance = 1e-13
[output]
interval = "1 ms"
[[body]]
name = "ground"
kind = "ground"
[[body]]
name = "rod"
kind = "deformable"
modes_file = "modes.h5"
damping_ratio = 0
[[marker]]
body = "ground"
name = "foot"
position = ["0 m", "0 m", "0 m"]
[[joint]]
name = "clamp"
kind = "fixed"
lower = "ground.foot"
upper = "rod.base"
"""


def bar():
    """Nodes and elements; the corners of a hexahedron: the lower face counter-clockwise, then the upper."""
    nodes = np.array([[x, y, z] for x in range(CELLS + 1) for y in (0, 1) for z in (0, 1)]) * SIDE
    node = lambda x, y, z: 4 * x + 2 * y + z
    elements = [[node(x + i, j, k) for k in (0, 1) for i, j in ((0, 0), (1, 0), (1, 1), (0, 1))]
                for x in range(CELLS)]
    clamp = [[node(0, 0, 0), node(0, 0, 1), node(0, 1, 1), node(0, 1, 0)]]  # its normal is -x
    return nodes, np.array(elements), np.array(clamp)


def write_msh(path):
    nodes, elements, clamp = bar()
    rows = [(3, 1, row) for row in clamp] + [(5, 2, row) for row in elements]
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat",
             "$PhysicalNames", "2", '2 1 "clamp"', '3 2 "bar"', "$EndPhysicalNames",
             "$Nodes", str(len(nodes))]
    lines += [" ".join(map(str, [n + 1, *point])) for n, point in enumerate(nodes)]
    lines += ["$EndNodes", "$Elements", str(len(rows))]
    lines += [" ".join(map(str, [e + 1, kind, 2, group, group, *(row + 1)]))
              for e, (kind, group, row) in enumerate(rows)]
    path.write_text("\n".join([*lines, "$EndElements", ""]))


def write_mesh(path):
    nodes, elements, clamp = bar()
    with h5py.File(path, "w") as file:
        file.attrs.update({"format": "flexneck mesh", "schema_version": 4, "units": "SI"})
        file["nodes"] = nodes
        file["nodes"].attrs["units"] = "m"
        file.create_group("materials/metal").attrs.update({
            "youngs_modulus_Pa": YOUNGS_MODULUS, "poissons_ratio": POISSONS_RATIO,
            "density_kg_m3": DENSITY, "index": 0})
        file["blocks/bar/hex8"] = elements  # 64 bits wide
        file["blocks/bar/hex8"].attrs.update({"material": "metal", "index": 0})
        file["node_sets/clamp"] = np.unique(clamp).astype("u1")
        file["node_sets/clamp"].attrs["index"] = 0
        file["face_sets/clamp/quad4"] = clamp.astype(">i4")
        for name in ("face_sets/clamp", "face_sets/clamp/quad4"):
            file[name].attrs["index"] = 0


def skew(vectors):
    x, y, z = np.moveaxis(np.asarray(vectors), -1, 0)
    zero = np.zeros_like(x)
    rows = [[zero, -z, y], [z, zero, -x], [-y, x, zero]]
    return np.moveaxis(np.array(rows), (0, 1), (-2, -1))


def write_modes(path):
    """The invariants are sums over the masses instead of integrals."""
    places = np.outer(HEIGHTS, [0, 0, 1]) + np.tile(CROSS, (len(HEIGHTS) // len(CROSS), 1))
    scale = 1 / np.sqrt(np.sum(MASSES * HEIGHTS**4))
    shapes = scale * np.array([np.outer(HEIGHTS**2, axis) for axis in ([1, 0, 0], [0, 1, 0])])
    slope = 2 * scale * HEIGHTS[-1]
    total = lambda terms: np.einsum("i,i...->...", MASSES, terms)
    s, psi = skew(places), skew(shapes)
    both = range(len(shapes))
    data = {
        "frequencies": (FREQUENCIES, "Hz"),
        "nodes": (places, "m"),
        "shapes": (shapes, "kg^-0.5"),
        "interfaces/base/position": (np.zeros(3), "m"),
        "interfaces/base/translation": (np.zeros((3, 2)), "kg^-0.5"),
        "interfaces/base/rotation": (np.zeros((3, 2)), "kg^-0.5 m^-1"),
        "interfaces/tip/position": ([0, 0, HEIGHTS[-1]], "m"),
        "interfaces/tip/translation": (shapes[:, -1].T, "kg^-0.5"),
        "interfaces/tip/rotation": (slope * np.array([[0, -1], [1, 0], [0, 0]]), "kg^-0.5 m^-1"),
        "invariants/mass": ([MASSES.sum()], "kg"),
        "invariants/S1": (total(places), "kg m"),
        "invariants/S2": (total(shapes.transpose(1, 2, 0)), "kg^0.5"),
        "invariants/J0": (-total(s @ s), "kg m^2"),
        "invariants/G0": ([-total(s @ psi[l]) for l in both], "kg^0.5 m"),
        "invariants/G": ([[-total(psi[j] @ psi[l]) for l in both] for j in both], "1"),
        "invariants/N0": (total(np.einsum("iab,lib->ial", s, shapes)), "kg^0.5 m"),
        "invariants/N": ([[total(np.einsum("iab,ib->ia", psi[j], shapes[l])) for l in both]
                          for j in both], "1"),
        "invariants/Maa": ([[total(np.sum(shapes[j] * shapes[l], axis=1)) for l in both]
                            for j in both], "1"),
        "basis/energy_fractions": (np.zeros((2, 4)), "percent"),
        "basis/residual": (np.zeros(2), "1"),
        "certificate/orthogonality": ([0.0], "1"),
    }
    with h5py.File(path, "w") as file:
        file.attrs.update({"format": "flexneck modal body", "schema_version": 2, "units": "SI"})
        for name, (values, unit) in data.items():
            file[name] = np.asarray(values, dtype="f8")
            file[name].attrs["units"] = unit
        file.create_dataset("mode_names", data=["swing x", "swing y"], dtype=TEXT)
        file.create_dataset("basis/kind", data=["normal", "normal"], dtype=TEXT)
        file["basis"].attrs["boundary"] = "fixed: base"
        file["certificate"].attrs["status"] = "not checked"


class ForeignFiles(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def flexneck(self, *words, code=0):
        done = subprocess.run([FLEXNECK, *words], check=False, capture_output=True, text=True,
                              cwd=self.folder)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done.stdout + (done.stderr if code else "")

    def test_a_mesh(self):
        write_msh(self.folder / "bar.msh")
        (self.folder / "bar.toml").write_text(STUDY)
        self.flexneck("mesh", "bar.toml", "-q", "-o", "own")
        (self.folder / "foreign").mkdir()
        write_mesh(self.folder / "foreign/mesh.h5")
        found = self.flexneck("info", "foreign/mesh.h5")
        for text in ("flexneck mesh, not verified", "4 elements, 20 nodes", "10.8 kg",
                     "an unknown program"):
            self.assertIn(text, found)
        self.assertIn(", verified", self.flexneck("info", "own/mesh.h5"))
        frequencies = []
        for place in ("own", "foreign"):
            self.flexneck("modes", "bar.toml", "-q", "-o", place)
            with h5py.File(self.folder / place / "modes.h5") as file:
                frequencies.append(file["frequencies"][:])
        np.testing.assert_allclose(frequencies[1], frequencies[0], rtol=1e-9)

    def test_modes(self):
        write_modes(self.folder / "modes.h5")
        (self.folder / "rod.toml").write_text(MODEL)
        self.assertIn("not verified", self.flexneck("info", "modes.h5"))
        self.flexneck("simulate", "rod.toml", "-q", "-o", "out")
        with h5py.File(self.folder / "out/rod.h5") as file:
            time, tip = file["time"][:], file["markers/rod.tip/position"][:]
        # One oscillator under a constant force, q'' + (2 pi f)^2 q = S2 g.
        scale = 1 / np.sqrt(np.sum(MASSES * HEIGHTS**4))
        pull = scale * np.sum(MASSES * HEIGHTS**2) * GRAVITY
        rate = 2 * np.pi * FREQUENCIES[0]
        deflection = scale * HEIGHTS[-1]**2 * pull / rate**2 * (1 - np.cos(rate * time))
        np.testing.assert_allclose(tip[:, 0], deflection, atol=1e-8 * deflection.max())
        np.testing.assert_allclose(tip[:, 1], 0, atol=1e-12)
        np.testing.assert_allclose(tip[:, 2], HEIGHTS[-1], atol=1e-12)

    def test_a_list_where_one_text_belongs(self):
        for texts in ([], ["one", "two"]):
            write_modes(self.folder / "modes.h5")
            with h5py.File(self.folder / "modes.h5", "a") as file:
                file.create_dataset("basis/solver", data=texts, dtype=TEXT)
            self.assertIn("/basis/solver: expected a single text",
                          self.flexneck("info", "modes.h5", code=2))


if __name__ == "__main__":
    FLEXNECK = str(Path(sys.argv.pop(1)).resolve())
    unittest.main(verbosity=2)
