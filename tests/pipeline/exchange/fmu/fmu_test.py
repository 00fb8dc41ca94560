#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The file modelDescription.xml of an FMU beside what the standard asks for: by its schema where FLEXNECK_SAMPLES names a
folder with fmi3/ (xmllint), and in any case by the rules that a schema cannot say.

Usage: fmu_test.py FLEXNECK MODEL.toml [TEST …]
"""

import ctypes
import math
import os
import re
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree
import zipfile
from pathlib import Path

FLEXNECK, MODEL = sys.argv[1], sys.argv[2]
SCHEMA = Path(os.environ.get("FLEXNECK_SAMPLES", "/nonexistent")) / "fmi3/fmi3ModelDescription.xsd"

SPRING = """
[solver]
end_time = "1 s"
relative_tolerance = 1e-10
absolute_tolerance = 1e-13
[[body]]
name = "ground"
kind = "ground"
[[body]]
name = "block"
kind = "rigid"
mass = "2 kg"
center = ["0 m", "0 m", "0 m"]
inertia = ["1e-3 kg*m^2", "1e-3 kg*m^2", "1e-3 kg*m^2"]
[[marker]]
body = "ground"
name = "rail"
position = ["0 m", "0 m", "0 m"]
[[marker]]
body = "block"
name = "center"
position = ["0 m", "0 m", "0 m"]
[[joint]]
name = "slide"
kind = "prismatic"
lower = "ground.rail"
upper = "block.center"
axis = [1, 0, 0]
distance = "0.1 m"
[[function_force]]
name = "spring"
lower = "ground.rail"
upper = "block.center"
Fx = "-200 * x"
[[channel]]
name = "place"
quantity = "position"
marker = "block.center"
"""


class Fmu(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="flexneck-fmu-")
        cls.addClassCleanup(cls.folder.cleanup)
        cls.path = Path(cls.folder.name) / "model.fmu"
        for target in (cls.path, cls.path.with_name("again.fmu")):
            subprocess.run([FLEXNECK, "export", "-q", MODEL, "--to", target], check=True)
        cls.zip = zipfile.ZipFile(cls.path)
        cls.addClassCleanup(cls.zip.close)
        cls.xml = cls.zip.read("modelDescription.xml")
        cls.root = ElementTree.fromstring(cls.xml)
        cls.variables = list(cls.root.find("ModelVariables"))

    def test_schema(self):
        if not SCHEMA.is_file():
            self.skipTest("not validated: FLEXNECK_SAMPLES names no folder with fmi3/")
        outcome = subprocess.run(["xmllint", "--noout", "--schema", SCHEMA, "-"], input=self.xml, capture_output=True)
        self.assertEqual(outcome.returncode, 0, outcome.stderr.decode())

    def test_contents(self):
        identifier = self.root.find("CoSimulation").get("modelIdentifier")
        self.assertRegex(identifier, r"^[A-Za-z_]\w*$")
        self.assertEqual(sorted(self.zip.namelist()), sorted(
            ["modelDescription.xml", f"binaries/x86_64-linux/{identifier}.so", "resources/model.bin"]))
        self.assertIsNone(self.zip.testzip())
        self.assertEqual(self.path.read_bytes(), self.path.with_name("again.fmu").read_bytes())

    def test_variables(self):
        names = [each.get("name") for each in self.variables]
        references = [int(each.get("valueReference")) for each in self.variables]
        self.assertEqual(len(set(names)), len(names))
        self.assertEqual(references, list(range(len(names))))
        units = {unit.get("name") for unit in self.root.find("UnitDefinitions")}
        self.assertTrue({each.get("unit") for each in self.variables} <= units)
        self.assertEqual([each.get("causality") for each in self.variables].count("independent"), 1)
        for each in self.variables:
            has_start = each.get("causality") in ("parameter", "input")
            self.assertEqual(each.get("start") is not None, has_start, each.get("name"))
        outputs = [reference for reference, each in zip(references, self.variables) if each.get("causality") == "output"]
        structure = self.root.find("ModelStructure")
        for element in ("Output", "InitialUnknown"):
            self.assertEqual([int(each.get("valueReference")) for each in structure.findall(element)], outputs)

    def test_shared_object(self):
        """It needs the C library alone, and shows the functions of the interface alone."""
        path = self.zip.extract([name for name in self.zip.namelist() if name.endswith(".so")][0], self.folder.name)
        needed = subprocess.run(["readelf", "-d", path], check=True, capture_output=True, text=True).stdout
        found = set(re.findall(r"\(NEEDED\).*\[([\w+-]+)\.so", needed))
        self.assertTrue(found <= {"libc", "libm", "ld-linux-x86-64", "libasan", "libubsan"}, found)
        symbols = subprocess.run(["nm", "-D", "--defined-only", path], check=True, capture_output=True, text=True).stdout
        shown = {line.split()[-1] for line in symbols.splitlines()}
        self.assertEqual({name for name in shown if not name.startswith("fmi3")}, set())
        self.assertGreaterEqual(len(shown), 60)

class Formulas(unittest.TestCase):
    def test_muparser_comes_along(self):
        """In a process that has none: it is loaded from the FMU's own folder."""
        with tempfile.TemporaryDirectory(prefix="flexneck-fmu-") as folder:
            at = Path(folder)
            (at / "block.toml").write_text(SPRING)
            subprocess.run([FLEXNECK, "export", "-q", at / "block.toml", "--to", at / "block.fmu"], check=True)
            with zipfile.ZipFile(at / "block.fmu") as archive:
                archive.extractall(at)
            self.assertIn("Redistribution", (at / "documentation/licenses/muparser.txt").read_text())
            root = ElementTree.parse(at / "modelDescription.xml").getroot()
            references = {each.get("name"): int(each.get("valueReference")) for each in root.find("ModelVariables")}
            fmu = ctypes.CDLL(at / "binaries/x86_64-linux/block.so")
            self.assertIn(f"{folder}/binaries/x86_64-linux/libmuparser.so", Path("/proc/self/maps").read_text())
            fmu.fmi3InstantiateCoSimulation.restype = ctypes.c_void_p
            instance = ctypes.c_void_p(fmu.fmi3InstantiateCoSimulation(
                b"run", root.get("instantiationToken").encode(), f"{folder}/resources/".encode(), False, False, False,
                False, None, ctypes.c_size_t(0), None, None, None))
            self.assertTrue(instance)
            zero = ctypes.c_double(0)
            self.assertEqual(fmu.fmi3EnterInitializationMode(instance, False, zero, zero, False, zero), 0)
            self.assertEqual(fmu.fmi3ExitInitializationMode(instance), 0)
            x, last, flags = ctypes.c_double(), ctypes.c_double(), [ctypes.c_bool() for _ in range(3)]
            for k in range(1, 101):
                self.assertEqual(fmu.fmi3DoStep(instance, ctypes.c_double((k - 1) * 0.01), ctypes.c_double(0.01), True,
                                                *map(ctypes.byref, flags), ctypes.byref(last)), 0)
                self.assertEqual(fmu.fmi3GetFloat64(instance, ctypes.byref(ctypes.c_uint32(references["place.x"])),
                                                    ctypes.c_size_t(1), ctypes.byref(x), ctypes.c_size_t(1)), 0)
                self.assertAlmostEqual(x.value, 0.1 * math.cos(10 * k * 0.01), delta=1e-8)
            fmu.fmi3FreeInstance(instance)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]], verbosity=2)
