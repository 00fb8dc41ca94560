#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The build is installed into a prefix, which is then moved: the command finds what it ships there, by name
too, and a project of somebody else's is built against the libraries and compared with closed forms.

Usage: install_test.py BUILD SOURCES CXX
"""

import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

BUILD, SOURCES, CXX = Path(sys.argv[1]), Path(sys.argv[2]), sys.argv[3]
sys.path.insert(0, str(SOURCES / "tests/pipeline/manual"))
import links  # noqa: E402

CONSUMER = Path(__file__).resolve().parent / "consumer"
ENVIRONMENT = {**os.environ, "OMP_NUM_THREADS": "1", "LC_ALL": "C.UTF-8"}


def run(*words, at, **more):
    outcome = subprocess.run([str(word) for word in words], cwd=at, text=True, stdout=subprocess.PIPE,
                             stderr=subprocess.STDOUT, env={**ENVIRONMENT, **more}, check=False)
    return outcome.returncode, outcome.stdout


class Installed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp(prefix="flexneck-install-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        first = cls.folder / "first"
        code, text = run("cmake", "--install", BUILD, "--prefix", first, at=cls.folder)
        assert code == 0, text
        cls.prefix = cls.folder / "moved" / "to here"
        cls.prefix.parent.mkdir()
        first.rename(cls.prefix)
        cls.program = cls.prefix / "bin/flexneck"

    def flexneck(self, *words):
        return run(self.program, *words, at=self.folder)

    def one(self, pattern):
        (found,) = self.prefix.rglob(pattern)
        return found

    def test_nothing_installed_holds_a_path_of_the_sources(self):
        """Nor of the build, but for the debugger's notes in a build that has them."""
        for path in self.prefix.rglob("*"):
            if not path.is_file() or path.suffix == ".a":
                continue
            content = path.read_bytes()
            self.assertNotIn(bytes(BUILD) + b"/", content, path)
            self.assertNotIn(bytes(SOURCES) + b"/", content, path)

    def test_a_shipped_study_runs_by_its_name(self):
        code, text = self.flexneck("run", "cantilever", "-o", "bar")
        self.assertEqual(code, 0, text)
        self.assertIn("65.", text)  # Euler and Bernoulli: 65.9 Hz
        self.assertTrue((self.folder / "bar/report.html").is_file())
        code, text = self.flexneck("study", "-o", "bar")  # which the folder remembers
        self.assertEqual(code, 0, text)
        self.assertIn("70 GPa", text)
        study = (self.folder / "bar/study.json").read_text()
        self.assertNotIn(str(self.prefix), study)

    def test_texts_link_to_what_is_installed(self):
        texts = sorted(self.prefix.rglob("*.md"))
        self.assertGreater(len(texts), 30)
        self.assertEqual(list(links.dead_links(texts)), [])

    def test_only_the_mesher_loads_gmsh(self):
        for name, loads in (("bin/flexneck", False), ("lib/flexneck/flexneck-mesher", True)):
            code, text = run("ldd", self.prefix / name, at=self.folder)
            self.assertEqual((code, "libgmsh" in text), (0, loads), name)

    def test_a_mesher_that_is_missing_or_started_by_hand_is_told(self):
        mesher = self.one("flexneck-mesher")
        self.assertEqual(run(mesher, at=self.folder), (
            2, "flexneck-mesher: flexneck starts this program; see 'flexneck mesh --help'\n"))
        aside = mesher.rename(mesher.with_name("aside"))
        try:
            code, text = self.flexneck("mesh", "-q", "cantilever", "-o", "unmeshed")
        finally:
            aside.rename(mesher)
        self.assertEqual((code, text.count("\n")), (3, 1))
        self.assertIn("there is no lib/flexneck/flexneck-mesher beside or above it; reinstall flexneck", text)

    def test_the_built_in_study_and_regulations_are_found(self):
        code, text = self.flexneck("study")
        self.assertEqual(code, 0, text)
        self.assertIn("572.33", text)

    def test_a_study_includes_a_shipped_one_by_its_name(self):
        study = self.folder / "mine.toml"
        for name in ("hybrid3_a", "hybrid3_a.toml"):
            study.write_text(f'include = ["{name}"]\n[geometry]\nplate_thickness = "0.41 in"\n')
            code, text = self.flexneck("mesh", "--dry-run", study.name)
            self.assertEqual(code, 0, text)
            self.assertIn("0.41 in", self.flexneck("study", study.name)[1])

    def test_a_shipped_model_runs_by_its_name(self):
        code, text = self.flexneck("simulate", "four_bar", "--set", "solver.end_time=0.01 s", "-o", "bars")
        self.assertEqual(code, 0, text)
        self.assertTrue((self.folder / "bars/four_bar.csv").is_file())

    def test_what_is_here_goes_before_what_is_shipped(self):
        (self.folder / "cantilever.toml").write_text("[geometry]\nnonsense = 1\n")
        try:
            for name in ("cantilever", "cantilever.toml"):
                code, text = self.flexneck("study", name)
                self.assertEqual(code, 2)
                self.assertIn("cantilever.toml:2:", text)
        finally:
            (self.folder / "cantilever.toml").unlink()

    def test_a_name_that_is_nowhere_is_told(self):
        code, text = self.flexneck("run", "hybrid3_d")
        self.assertEqual((code, text.count("\n")), (2, 1))
        self.assertIn("no such file, and there is no shipped study or model 'hybrid3_d' (did you mean 'hybrid3_", text)

    def test_the_manual_page_has_every_command_and_option(self):
        page = self.one("flexneck.1")
        if shutil.which("groff") is None:
            self.skipTest("groff is not there")
        code, text = run("groff", "-man", "-ww", "-Tascii", "-P-cbou", "-rLL=200n", page, at=self.folder)
        self.assertEqual(code, 0)
        self.assertNotIn(": warning", text)
        commands = re.findall(r"^  ([a-z]+)  ", self.flexneck("--help")[1], re.MULTILINE)
        self.assertGreater(len(commands), 15)
        for command in commands:
            section = text[re.search(rf"^ +{command} \[", text, re.MULTILINE).start():]
            for option in re.findall(r"(--[a-z-]+)", self.flexneck(command, "--help")[1]):
                self.assertIn(option, section, command)

    def test_bash_completes_commands_options_and_shipped_names(self):
        def completed(*words):
            line = " ".join(f"'{word}'" for word in ("flexneck", *words))
            code, text = run("bash", "-c", f"source '{script}'; COMP_WORDS=({line}); COMP_CWORD={len(words)}; "
                             "_flexneck; printf '%s\\n' \"${COMPREPLY[@]}\"", at=CONSUMER)
            self.assertEqual(code, 0, text)
            return text.split()

        script = self.one("completions/flexneck")
        self.assertEqual(completed("mes"), ["mesh"])
        self.assertEqual(completed("mesh", "--ref"), ["--refine"])
        self.assertEqual(completed("modes", "--ref"), [])
        self.assertEqual(completed("run", "hybrid3_c_"), ["hybrid3_c_prime"])
        self.assertEqual(completed("run", "pend"), ["pendulum", "pendulum_bodies", "pendulum_chain", "pendulum.cpp"])

    def test_a_project_is_built_against_the_library(self):
        at = self.folder / "consumer"
        launcher = os.environ.get("CMAKE_CXX_COMPILER_LAUNCHER", "")
        code, text = run("cmake", "-S", CONSUMER, "-B", at, f"-DCMAKE_PREFIX_PATH={self.prefix}",
                         f"-DCMAKE_CXX_COMPILER={CXX}", f"-DCMAKE_CXX_COMPILER_LAUNCHER={launcher}", at=self.folder)
        self.assertEqual(code, 0, text)
        code, text = run("cmake", "--build", at, at=self.folder)
        self.assertEqual(code, 0, text)
        code, text = run(at / "pendulum", at=self.folder)
        self.assertEqual(code, 0, text)  # it compares with the closed forms
        self.assertIn("by energy", text)
        # The same object, built with the flags of pkg-config.
        pc = self.one("flexneck-multibody.pc").parent
        code, flags = run("pkg-config", "--cflags", "--libs", "flexneck-multibody", at=at,
                          PKG_CONFIG_PATH=str(pc))
        self.assertEqual(code, 0, flags)
        (compiled,) = at.rglob("pendulum.cpp.o")
        code, text = run(CXX, compiled, "-o", "linked", *shlex.split(flags), at=at)
        self.assertEqual(code, 0, text)
        self.assertEqual(run("./linked", at=at)[0], 0)

    def test_a_room_that_is_not_there_is_told(self):
        at = self.folder / "wrong"
        at.mkdir()
        (at / "CMakeLists.txt").write_text("cmake_minimum_required(VERSION 3.25)\nproject(wrong)\n"
                                           "find_package(flexneck REQUIRED COMPONENTS multybody)\n")
        code, text = run("cmake", "-S", at, "-B", at / "build", f"-DCMAKE_PREFIX_PATH={self.prefix}", at=at)
        self.assertNotEqual(code, 0)
        self.assertIn("flexneck has no room 'multybody'", text)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
