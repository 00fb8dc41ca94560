# SPDX-License-Identifier: GPL-3.0-or-later
"""Modal bodies: structures reduced to their modes."""

from __future__ import annotations

import pathlib
import shutil
import typing

import numpy as np

from . import _core
from .errors import InputError
from .folders import Folder, Path, execute
from .run import Run
from .values import describe

if typing.TYPE_CHECKING:
    import numpy.typing as npt

    from .study import Study

    Array = npt.NDArray[np.float64]


class Interface(typing.NamedTuple):
    """A place where other bodies attach: a rigid frame that moves with the modes."""

    position: Array
    translation: Array
    rotation: Array


describe(
    Interface,
    position="Undeformed position, (3,), m, body frame; a view.",
    translation="Translation in each mode, (m, 3), kg^(-1/2); a view.",
    rotation="Rotation in each mode, (m, 3), kg^(-1/2) rad/m; a view.",
)


class ModalBody:
    """A body reduced to m mass-normalised modes, from Mesh.modes() or ModalBody.read()."""

    def __init__(self, data: typing.Any, study: Study | None, folder: Folder | None,
                 path: str) -> None:
        self._data = data
        self._study = None if study is None else study.copy()
        self._folder = folder
        self._path = path
        self._imported: Folder | None = None  # holds the file of a body of another program

    @staticmethod
    def read(path: Path) -> ModalBody:
        """Reads a body from a file modes.h5, or from a file of another program: .fem (MBDyn) or
        .SID_FEM; a warning lists the data that such a file does not contain. A body that is read
        from a file has no experiments; use Mesh.modes() for these."""
        if pathlib.Path(path).suffix not in (".fem", ".SID_FEM"):
            return ModalBody(_core.read_body(str(path)), None, None, str(path))
        place = Folder(None)
        execute("export", place, [str(path)], [], target=place.file("modes.h5"))
        body = ModalBody.read(place.file("modes.h5"))
        body._imported = place
        return body

    @staticmethod
    def build(path: Path, *, names: typing.Sequence[str], frequencies: npt.ArrayLike,
              nodes: npt.ArrayLike, shapes: npt.ArrayLike,
              interfaces: typing.Mapping[str, Interface],
              invariants: typing.Mapping[str, typing.Any],
              kinds: typing.Sequence[str] | None = None) -> ModalBody:
        """Writes a body with m mass-normalised modes, given by arrays, to a file modes.h5 that
        models can use, and reads it back.

        names: of the modes. frequencies: (m,), Hz, ascending. nodes: (k, 3), m. shapes: (m, k, 3),
        kg^(-1/2). interfaces: by name. invariants: all entries of the property `invariants`. kinds:
        of the modes; default: all normal. Raises InputError if the arrays are inconsistent
        (the manual's page on reduction).
        """
        arrays = {"frequencies": frequencies, "nodes": nodes, "shapes": shapes}
        _core.build_body(str(path), list(names), list(kinds or ["normal"] * len(names)),
                         arrays, {name: each._asdict() for name, each in interfaces.items()},
                         dict(invariants))
        return ModalBody.read(path)

    @property
    def frequencies(self) -> Array:
        """Frequencies of the modes, ascending, (m,), Hz; a view."""
        return typing.cast("Array", self._data.frequencies)

    @property
    def names(self) -> list[str]:
        """Names of the modes, such as "fore-aft bending 1"."""
        return [each[0] for each in self._data.modes]

    @property
    def kinds(self) -> list[str]:
        """Kinds of the modes: "normal" for an eigenvector, or the kind of a static shape."""
        return [each[1] for each in self._data.modes]

    @property
    def shares(self) -> Array:
        """Shares of the kinetic energy of each mode in fore-aft, lateral, twisting and axial
        motion, (m, 4), per cent."""
        return np.array([each[2] for each in self._data.modes])

    @property
    def residuals(self) -> Array:
        """Residual ||K x - lambda M x|| / ||K x|| of each mode, (m,), 1."""
        return np.array([each[3] for each in self._data.modes])

    @property
    def nodes(self) -> Array:
        """Undeformed positions of the nodes, (k, 3), m, body frame; a view."""
        return typing.cast("Array", self._data.nodes)

    def shape(self, mode: str | int) -> Array:
        """Shape of a mode, by its name or its index: (k, 3), kg^(-1/2), a row for each of `nodes`;
        a view."""
        if isinstance(mode, str):
            if mode not in self.names:
                raise InputError(f"there is no mode '{mode}'; there are: {', '.join(self.names)}")
            mode = self.names.index(mode)
        return typing.cast("Array", self._data.shapes[mode])

    @property
    def interfaces(self) -> dict[str, Interface]:
        """Interfaces at which other bodies are attached, by name."""
        return {name: Interface(*each) for name, each in self._data.interfaces.items()}

    @property
    def mass(self) -> float:
        """Mass of the body, kg."""
        return float(self._data.invariants["mass"])

    @property
    def invariants(self) -> dict[str, typing.Any]:
        """Inertia invariants after Yoo and Haug, over the undeformed volume, s0 the position and
        psi the shapes: mass (kg), S1 (3,) int rho s0 (kg m), S2 (m, 3) int rho psi (kg^(1/2)), J0
        (3, 3) (kg m^2), G0 (m, 3, 3) (kg^(1/2) m), G (m, m, 3, 3) (1), N0 (m, 3) (kg^(1/2) m), N
        (m, m, 3) (1), Maa (m, m) (1)."""
        return dict(self._data.invariants)

    @property
    def boundary(self) -> str:
        """Boundary conditions: what was fixed."""
        return str(self._data.boundary)

    @property
    def completeness(self) -> str:
        """Result of the check that no mode is missing."""
        return str(self._data.completeness)

    def pendulum(self, case: str) -> Run:
        """Runs a case of the head/neck pendulum, as `flexneck pendulum --case` does.

        case: name of the case, such as "flexion-120"; Study.cases lists all.
        """
        return self._experiment("pendulum", case)

    def static(self, case: str) -> Run:
        """Runs a case of the static neck tester, as `flexneck static --case` does. The output times
        are those of the load ramp."""
        return self._experiment("static", case)

    def _experiment(self, kind: str, case: str) -> Run:
        study, folder = self._require("experiments")
        cases = [name for name, of in study.cases.items() if of == kind]
        if case not in cases:
            raise InputError(f"{study.file}: there is no {kind} case '{case}'; there are: "
                             + (", ".join(cases) or "none"))
        study.set("cases", [case])
        execute(kind, folder, [study.file], study.settings)
        return Run(_core.read_run(folder.file(f"{kind}-{case}.h5")), folder, f"{kind}-{case}")

    def export(self, path: Path) -> None:
        """Writes the body in the format given by the extension of the file, as `flexneck export`
        does, such as .fem (MBDyn), or with its mesh .dat (ATB) or .vtu. The InputError for an
        unknown extension lists all of them."""
        if _core.exports_study(pathlib.Path(path).suffix):
            study, folder = self._require("mesh")
            execute("export", folder, [study.file], study.settings, target=str(path))
        else:
            execute("export", Folder("."), [self._path], [], target=str(path))

    def write(self, path: Path) -> None:
        """Writes the file that read() reads, identical to modes.h5 of the command."""
        shutil.copyfile(self._path, path)

    @property
    def folder(self) -> pathlib.Path | None:
        """The folder of results; None for a body that was read from a file."""
        return None if self._folder is None else self._folder.path

    def _require(self, what: str) -> tuple[Study, Folder]:
        if self._study is None or self._folder is None:
            raise InputError(f"this body was read from a file and has no {what}; compute it with "
                             "Mesh.modes()")
        return self._study.copy(), self._folder

    def __repr__(self) -> str:
        return f"<ModalBody: {len(self.frequencies)} modes from {self.frequencies[0]:.4g} Hz>"
