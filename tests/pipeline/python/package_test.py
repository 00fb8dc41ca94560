# SPDX-License-Identifier: GPL-3.0-or-later
"""The Python package beside the command: the same bytes, no copies, errors, Ctrl-C, threads, leaks.

Usage: package_test.py BUILD SOURCES [--calls N] [TEST ...]     (PYTHONPATH has the package)
"""

import _thread
import ctypes
import filecmp
import gc
import os
import pathlib
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import warnings

import numpy as np

import flexneck as fn

BUILD, SOURCES = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
COARSE = ["mesh.quadrant=2", "mesh.inner_ring=2", "mesh.outer_ring=1", "mesh.rubber_layers=1",
          "geometry.bolt_patch_radius=0.4 in", "pendulum.duration=0.1 s"]

SPRING = {
    "solver": {"end_time": "0.5 s", "relative_tolerance": 1e-9, "absolute_tolerance": 1e-12},
    "output": {"interval": "1 ms"},
    "body": [{"name": "ground", "kind": "ground"},
             {"name": "block", "kind": "rigid", "mass": "2 kg", "center": ["0 m", "0 m", "0 m"],
              "inertia": ["1e-3 kg*m^2", "1e-3 kg*m^2", "1e-3 kg*m^2"]}],
    "marker": [{"body": "ground", "name": "rail", "position": ["0 m", "0 m", "0 m"]},
               {"body": "block", "name": "center", "position": ["0 m", "0 m", "0 m"]}],
    "joint": [{"name": "slide", "kind": "prismatic", "lower": "ground.rail",
               "upper": "block.center", "axis": [1, 0, 0], "distance": "0.1 m"}],
}
ENDS = ("ground.rail", "block.center")


def flexneck(*arguments):
    subprocess.run([BUILD / "flexneck", *map(str, arguments)], check=True, capture_output=True)


def linear(time_s, position, velocity, rotation, angular_velocity):
    return -400 * position, np.zeros(3)


def long_run():
    return fn.Model("four_bar", ["solver.end_time=1000 s", "output.interval=10 s",
                                 "solver.relative_tolerance=1e-12"])


class InFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)


class Stages(InFolder):
    def test_mesh_modes_and_pendulum_have_the_bytes_of_the_commands(self):
        study = fn.Study("hybrid3", COARSE).set("geometry.plate_thickness", "0.4 in")
        mesh = study.mesh(self.folder / "python")
        body = mesh.modes(count=6)
        run = body.pendulum("flexion-20")
        settings = [f"--set={each}" for each in study.settings]
        out = ["-o", self.folder / "command"]
        flexneck("mesh", "hybrid3", *settings, *out)
        flexneck("modes", "hybrid3", *settings, "--set=modes.count=6", *out)
        flexneck("pendulum", "hybrid3", *settings, "--set=modes.count=6", "--case", "flexion-20", *out)
        names = ["mesh.h5", "modes.h5", "pendulum-flexion-20.h5", "pendulum-flexion-20.csv",
                 "pendulum.json"]
        _, different, missing = filecmp.cmpfiles(self.folder / "python", self.folder / "command",
                                                 names, shallow=False)
        self.assertEqual((different, missing), ([], []))

        self.assertEqual(body.frequencies.shape, (6,))
        self.assertEqual(body.shape(body.names[0]).shape, body.nodes.shape)
        self.assertAlmostEqual(mesh.mass, body.mass, delta=1e-9)
        np.testing.assert_allclose(run["head rotation"].to("deg"),
                                   np.degrees(run["head rotation"].values), rtol=1e-14)
        table = fn.Results(self.folder / "python").tables["peaks"]
        self.assertEqual(table["case"], ["flexion-20"])
        run.write(self.folder / "copy.h5")
        again = fn.Run.read(self.folder / "copy.h5")
        np.testing.assert_array_equal(again.time, run.time)
        body.export(self.folder / "neck.vtu")
        self.assertTrue((self.folder / "neck.vtu").stat().st_size > 0)
        with self.assertWarnsRegex(fn.ResultWarning, "not carried over"):
            body.export(self.folder / "python.fem")
        flexneck("export", self.folder / "command/modes.h5", "--to", self.folder / "command.fem")
        self.assertEqual((self.folder / "python.fem").read_bytes(),
                         (self.folder / "command.fem").read_bytes())
        back = fn.ModalBody.read(self.folder / "command.fem")
        np.testing.assert_allclose(back.frequencies, body.frequencies, rtol=1e-12)
        self.assertEqual(back.names, body.names)
        back.write(self.folder / "back.h5")
        (self.folder / "cut.fem").write_bytes((self.folder / "command.fem").read_bytes()[:-30])
        with self.assertRaisesRegex(fn.InputError, "cut.fem:.*the file ends too early"):
            fn.ModalBody.read(self.folder / "cut.fem")
        # Modes in the folder made with other values are refused, as by the command.
        with self.assertWarnsRegex(fn.ResultWarning, "modes.count = 6, now with 4"):
            mesh.modes(count=4)
        with self.assertRaisesRegex(fn.InputError, "modes.h5"):
            body.pendulum("flexion-20")

    def test_modes_are_computed_again_and_again_in_one_process(self):
        mesh = fn.Study("cantilever").mesh()
        first = mesh.modes(count=2)
        with self.assertWarns(fn.ResultWarning):
            second = mesh.modes(count=3)
        self.assertEqual(len(second.frequencies), 3)
        np.testing.assert_allclose(first.frequencies, second.frequencies[:2], rtol=1e-9)

    def test_a_body_that_is_built_from_its_arrays_is_the_same(self):
        body = fn.Study("cantilever").mesh().modes(count=3)
        shapes = np.array([body.shape(k) for k in range(3)])
        built = fn.ModalBody.build(
            self.folder / "built.h5", names=body.names, frequencies=body.frequencies,
            nodes=body.nodes, shapes=shapes, interfaces=body.interfaces, kinds=body.kinds,
            invariants=body.invariants)
        for name, value in body.invariants.items():
            np.testing.assert_array_equal(built.invariants[name], value)
        np.testing.assert_array_equal(built.shape(2), body.shape(2))
        with self.assertRaisesRegex(fn.InputError, "shapes: expected an array of the shape"):
            fn.ModalBody.build(self.folder / "bad.h5", names=body.names, shapes=shapes[:, 1:],
                               frequencies=body.frequencies, nodes=body.nodes, interfaces={},
                               invariants=body.invariants)
        with self.assertRaisesRegex(fn.InputError, "Maa"):
            fn.ModalBody.build(self.folder / "bad.h5", names=body.names, shapes=shapes,
                               frequencies=body.frequencies, nodes=body.nodes, interfaces={},
                               invariants={**body.invariants, "Maa": 2 * np.eye(3)})
        self.assertFalse((self.folder / "bad.h5").exists())

    def test_a_sweep_is_the_commands(self):
        (self.folder / "study.toml").write_text(
            'include = ["cantilever"]\n[sweep]\nplan = "grid"\n'
            'outputs = ["modes.mass"]\n[[sweep.parameter]]\nkey = "modes.count"\nvalues = [2, 3]\n')
        fn.Study(self.folder / "study.toml").sweep(self.folder / "python", threads=1)
        flexneck("sweep", self.folder / "study.toml", "-o", self.folder / "command")
        self.assertTrue(filecmp.cmp(self.folder / "python/sweep.csv",
                                    self.folder / "command/sweep.csv", shallow=False))


class Models(InFolder):
    def test_a_run_has_the_bytes_of_the_command(self):
        flexneck("simulate", "four_bar", "--set", "solver.end_time=0.2 s", "-o", self.folder / "command")
        model = fn.Model("four_bar").set("solver.end_time", "0.2 s")
        model.simulate(self.folder / "python")
        kept = model.simulate()  # in memory
        kept.write(self.folder / "memory.h5")
        kept.write_table(self.folder / "memory.csv")
        for name in ("four_bar.h5", "four_bar.csv"):
            expected = (self.folder / "command" / name).read_bytes()
            self.assertEqual((self.folder / "python" / name).read_bytes(), expected)
            self.assertEqual((self.folder / name.replace("four_bar", "memory")).read_bytes(), expected)

    def test_a_function_of_python_is_the_formula(self):
        tables = {**SPRING, "function_force": [{"name": "spring", "lower": ENDS[0], "upper": ENDS[1],
                                                "Fx": "-400 * x"}]}
        formula = fn.Model(tables).simulate()
        python = fn.Model(SPRING).add_function("spring", *ENDS, linear).simulate()
        x = python.markers["block.center"].position[:, 0]
        np.testing.assert_allclose(x, 0.1 * np.cos(np.sqrt(200) * python.time), atol=1e-8)
        np.testing.assert_allclose(x, formula.markers["block.center"].position[:, 0], atol=1e-10)
        self.assertIn("function_force.spring", python.values)

    def test_an_fmu_has_the_bytes_of_the_commands(self):
        tables = {**SPRING, "function_force": [{"name": "spring", "lower": ENDS[0], "upper": ENDS[1],
                                                "Fx": "-400 * x"}]}
        model = fn.Model(tables, name="block")
        model.export(self.folder / "python.fmu")
        (self.folder / "block.toml").write_text(model.text)
        flexneck("export", self.folder / "block.toml", "--to", self.folder / "command.fmu")
        self.assertEqual((self.folder / "python.fmu").read_bytes(), (self.folder / "command.fmu").read_bytes())
        with self.assertRaisesRegex(fn.InputError, "extension .fmu"):
            model.export(self.folder / "block.fem")
        prototype = fn.Model(SPRING).add_function("mine", *ENDS, linear)
        with self.assertRaisesRegex(fn.InputError, "function_force 'mine': its load is a function of a program"):
            prototype.export(self.folder / "prototype.fmu")
        self.assertFalse((self.folder / "prototype.fmu").exists())

    def test_what_a_function_raises_ends_the_run(self):
        def failing(time_s, *motion):
            raise ZeroDivisionError("mine")
        with self.assertRaisesRegex(ZeroDivisionError, "mine"):
            fn.Model(SPRING).add_function("f", *ENDS, failing).simulate()
        for wrong in (None, ([1, 2], [0, 0, 0]), ("a", "b")):
            with self.assertRaisesRegex(fn.InputError, "function_force 'f': expected"):
                fn.Model(SPRING).add_function("f", *ENDS, lambda *motion: wrong).simulate()
        with self.assertRaisesRegex(fn.ComputationError, "a load that is not finite") as caught:
            fn.Model(SPRING).add_function(
                "f", *ENDS, lambda t, *motion: ([0 if t < 0.1 else np.nan, 0, 0], [0, 0, 0])).simulate()
        self.assertLess(caught.exception.run.time[-1], 0.11)
        self.assertIn("a load that is not finite", caught.exception.run.incomplete)
        with self.assertRaisesRegex(fn.InputError, "block.nose"):
            fn.Model(SPRING).add_function("f", ENDS[0], "block.nose", linear)


class Arrays(unittest.TestCase):
    def test_large_arrays_are_views_on_the_programs_memory(self):
        run = fn.Model("four_bar", ["solver.end_time=0.1 s"]).simulate()
        mesh = fn.Study("cantilever").mesh()
        body = mesh.modes(count=2)
        arrays = {
            "mesh": lambda: mesh.nodes, "elements": lambda: mesh.blocks[0].nodes,
            "set": lambda: mesh.node_sets["clamp"],
            "time": lambda: run.time, "energy": lambda: run.energy["kinetic"],
            "position": lambda: run.markers["crank.tip"].position,
            "force": lambda: run.joints["A"].force,
            "channel": lambda: run.channels[next(iter(run.channels))].values,
            "frequencies": lambda: body.frequencies, "shape": lambda: body.shape(1),
            "nodes": lambda: body.nodes,
        }
        for name, read in arrays.items():
            with self.subTest(name):
                first, second = read(), read()  # both alive, so that no copy could take the other's place
                self.assertEqual(first.ctypes.data, second.ctypes.data)
                self.assertIsNotNone(first.base)
                with self.assertRaises(ValueError):
                    read()[0] = 1

    def test_a_view_outlives_the_run(self):
        time = fn.Model("four_bar", ["solver.end_time=0.1 s"]).simulate().time
        gc.collect()
        np.testing.assert_allclose(time, np.arange(101) * 1e-3, atol=1e-15)


class Errors(InFolder):
    def test_errors_map(self):
        self.assertTrue(issubclass(fn.InputError, ValueError))
        self.assertTrue(issubclass(fn.ComputationError, RuntimeError))
        with self.assertRaisesRegex(fn.InputError, "no shipped study or model 'hybrid4'"):
            fn.Study("hybrid4")
        study = fn.Study("hybrid3")
        with self.assertRaisesRegex(fn.InputError, "plate_thicknes"):
            study.set("geometry.plate_thicknes", "0.4 in")
        self.assertEqual(study.settings, [])  # as it was
        with self.assertRaisesRegex(fn.InputError, "kg"):
            study.set("geometry.plate_thickness", "0.4 kg")
        with self.assertRaisesRegex(fn.InputError, "expected a text, a number"):
            study.set("geometry.plate_thickness", object())
        for wrong in (lambda: fn.Study("hybrid3", "modes.count=6"), lambda: fn.Model({5: {}}),
                      lambda: fn.iso18571("text", [1]), lambda: fn.cora(np.ones((200, 2)), np.ones(200))):
            self.assertRaisesRegex(fn.InputError, "^[^\n]*expected [^\n]*$", wrong)
        with self.assertRaisesRegex(fn.InputError, "cannot be read|no such file|does not exist"):
            fn.Run.read(self.folder / "none.h5")
        (self.folder / "text.h5").write_text("no HDF5")
        with self.assertRaises(fn.InputError):
            fn.ModalBody.read(self.folder / "text.h5")

    def test_a_run_that_cannot_go_on_keeps_what_there_is(self):
        with self.assertRaisesRegex(fn.IncompleteRunError, "steps") as caught:
            fn.Model("four_bar", ["solver.max_steps=50"]).simulate()
        self.assertGreater(len(caught.exception.run.time), 1)
        self.assertIn("50 steps", caught.exception.run.incomplete)

    def test_warnings_are_pythons(self):
        heavy = ["geometry.materials.aluminium.density=1.048e6 kg/m^3"]
        with self.assertWarnsRegex(fn.ResultWarning, "was it given as a weight density in lbf/in"):
            fn.Study("cantilever", heavy).mesh()


class Threads(unittest.TestCase):
    def test_ctrl_c_stops_a_run(self):
        threading.Timer(0.3, _thread.interrupt_main).start()
        with self.assertRaises(KeyboardInterrupt):
            long_run().simulate()
        fn.Model("four_bar", ["solver.end_time=0.01 s"]).simulate()  # and the next one runs

    def test_other_threads_run_meanwhile(self):
        counted, stop = [0], threading.Event()

        def count():
            while not stop.is_set():
                counted[0] += 1
                time.sleep(0.001)
        other = threading.Thread(target=count)
        other.start()
        fn.Model("four_bar", ["solver.end_time=20 s"]).simulate()
        stop.set()
        other.join()
        self.assertGreater(counted[0], 20)

    def test_runs_in_several_threads_are_the_same(self):
        ends = []

        def run():
            ends.append(fn.Model("four_bar", ["solver.end_time=0.2 s"]).simulate().energy["kinetic"][-1])
        threads = [threading.Thread(target=run) for _ in range(4)]
        for each in threads:
            each.start()
        for each in threads:
            each.join()
        self.assertEqual(len(set(ends)), 1)
        self.assertEqual(len(ends), 4)


class MallocInfo(ctypes.Structure):
    """struct mallinfo2 of the C library, over all its arenas."""
    _fields_ = [(name, ctypes.c_size_t) for name in (
        "arena", "ordblks", "smblks", "hblks", "hblkhd", "usmblks", "fsmblks", "uordblks", "fordblks", "keepcost")]


def in_use():
    """Bytes that are allocated, and blocks that are allocated by Python itself."""
    gc.collect()
    read = ctypes.CDLL(None).mallinfo2
    read.restype = MallocInfo
    info = read()
    return info.uordblks + info.hblkhd, sys.getallocatedblocks()


class Leaks(unittest.TestCase):
    COUNT = 200

    def test_calls_leave_nothing_behind(self):
        model = fn.Model(SPRING, ["solver.end_time=10 ms"]).add_function("f", *ENDS, linear)
        body = fn.Study("cantilever").mesh().modes(count=2)
        curve = np.sin(np.arange(200) * 0.05)
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        history = pathlib.Path(folder.name) / "run.h5"
        model.simulate().write(history)

        def call():
            run = model.simulate()
            run.markers["block.center"].position.sum()
            run.channels
            body.shape(1).sum()
            body.invariants
            fn.iso18571(curve, curve)
            fn.Run.read(history).time.sum()
            with self.assertRaises(fn.InputError):
                fn.Model({"solver": {}})
        def more():
            before = in_use()
            for _ in range(self.COUNT):
                call()
            return [after - was for after, was in zip(in_use(), before)]
        more()  # fills what is kept for good
        # Python's caches still grow now and then; a leak shows in each repetition.
        more_bytes, more_blocks = (min(each) for each in zip(more(), more(), more()))
        print(f"{self.COUNT} calls, {more_bytes} bytes and {more_blocks} blocks of Python more")
        # The C library keeps some free memory for each thread. A leak of 16 bytes a call shows in
        # 10^4.
        self.assertLess(more_bytes, 100_000)
        self.assertLess(more_blocks, 100)


class Mpi(unittest.TestCase):
    def test_importing_starts_no_mpi(self):
        code = ("import sys, flexneck\nimport ctypes\nlib = ctypes.CDLL('libmpi.so.40')\n"
                "flag = ctypes.c_int()\nlib.MPI_Initialized(ctypes.byref(flag))\nprint(flag.value)")
        found = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)
        self.assertEqual(found.stdout.strip(), "0")

    def test_an_mpirun_that_is_started_later_is_one_of_its_own(self):
        fn.Study("cantilever").mesh()  # starts MPI here
        subprocess.run(["mpirun", "-n", "2", "--oversubscribe", BUILD / "flexneck", "modes", "--help"],
                       check=True, capture_output=True,
                       env={**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1",
                            "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"})


class Paths(InFolder):
    def test_what_the_file_system_throws_is_an_error_of_the_package(self):
        damaged = self.folder / "damaged.h5"
        damaged.write_bytes(b"\x89HDF\r\n\x1a\n" + bytes(range(256)) * 4)
        for path in ("a" * 300, "/".join(["d" * 100] * 60), self.folder / "b" / ("a" * 256),
                     self.folder / "none.h5", damaged, self.folder):
            for read in (fn.Run.read, fn.Study, fn.Model):
                with self.subTest(path=str(path)[-30:], read=read), self.assertRaises(fn.InputError):
                    read(path)
        for path in ("a" * 300, "/".join(["d" * 100] * 60)):
            with self.assertRaises(fn.InputError):
                fn.Study("cantilever").mesh(path)


class Surroundings(unittest.TestCase):
    def after(self, code, **variables):
        return subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True,
                              env={**os.environ, **variables}).stdout.strip()

    def test_importing_leaves_the_environment_and_the_threads_of_the_blas(self):
        code = ("import ctypes, os\nblas = ctypes.CDLL('libopenblas.so.0', mode=ctypes.RTLD_GLOBAL)\n"
                "environ = ctypes.POINTER(ctypes.c_char_p).in_dll(ctypes.CDLL(None), 'environ')\n"
                "def state():\n"
                "    variables = set()\n"
                "    while environ[len(variables)]: variables.add(environ[len(variables)])\n"
                "    return variables, blas.openblas_get_num_threads()\n"
                "blas.openblas_set_num_threads(2)\nbefore = state()\nimport flexneck\n"
                "assert state() == before\nprint('as before')")
        self.assertEqual(self.after(code, OMP_NUM_THREADS="2"), "as before")

    def test_another_data_base_of_units_in_the_environment_has_no_effect(self):
        with tempfile.NamedTemporaryFile("w", suffix=".xml") as other:
            other.write("<unit-system><unit><base/><name><singular>metre</singular></name>"
                        "<symbol>m</symbol></unit></unit-system>")
            other.flush()
            for path in (other.name, "/nowhere"):
                code = "import flexneck as fn\nprint(f\"{fn.quantity('1 in', 'mm'):.9g}\")"
                self.assertEqual(self.after(code, UDUNITS2_XML_PATH=path), "25.4")


if __name__ == "__main__":
    warnings.simplefilter("error", fn.ResultWarning)
    if "--calls" in sys.argv:
        at = sys.argv.index("--calls")
        Leaks.COUNT = int(sys.argv[at + 1])
        del sys.argv[at:at + 2]
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]], verbosity=2)
