#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The file modelDescription.xml of an FMU beside what the standard asks for: by its schema where FLEXNECK_SAMPLES names a
folder with fmi3/ (xmllint), and in any case by the rules that a schema cannot say.

Usage: fmu_test.py FLEXNECK MODEL.toml
"""

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


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
