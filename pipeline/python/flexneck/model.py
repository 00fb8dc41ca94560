# SPDX-License-Identifier: GPL-3.0-or-later
"""Models of rigid and deformable bodies, joints and forces."""

from __future__ import annotations

import os
import pathlib
import typing

from . import _core
from .errors import IncompleteRunError, InputError, warn
from .folders import Folder, Path
from .run import Run
from .settings import HasSettings, checked
from .toml_text import document_text
from .values import Value

if typing.TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

    Array = npt.NDArray[np.float64]
    Vector = typing.Union[Array, typing.Sequence[float]]
    Function = typing.Callable[[float, Array, Array, Array, Array], tuple[Vector, Vector]]


class Model(HasSettings):
    """A model: a shipped one by its name ("four_bar"), a TOML file, or a dictionary of the same
    tables and keys, such as

        Model({"solver": {"end_time": "1 s"}, "body": [{"name": "ground", "kind": "prescribed"}, ...]})

    `flexneck keys model` lists all keys with their units. Raises InputError for invalid input.
    """

    def __init__(self, model: Path | typing.Mapping[str, typing.Any],
                 settings: typing.Sequence[str] = (), folder: Path = ".",
                 name: str = "model") -> None:
        """settings: "key=value", as `--set` of the command line.
        folder: for a dictionary: folder of the files that it refers to. name: name of its results."""
        self._text: str | None = None
        if isinstance(model, typing.Mapping):
            self._text = document_text(dict(model))
            self._path = os.path.abspath(pathlib.Path(folder) / (name + ".toml"))
        else:
            self._path = os.path.abspath(_core.named_file(str(model)))
        self._settings = checked(settings)
        self._functions: dict[str, tuple[str, str, Function]] = {}
        self._read()
        warn(self._data.warnings)

    def _read(self) -> None:
        data = _core.ModelData(self._path, self._text, self._settings)
        for name, (lower, upper, function) in self._functions.items():
            data.add_function(name, lower, upper, function)
        self._data = data

    def set(self, key: str, value: typing.Any) -> Model:
        """Sets the value of a key, as `--set key=value` of the command line does; see
        Study.set()."""
        self._set(key, value)
        return self

    def add_function(self, name: str, lower: str, upper: str, function: Function) -> Model:
        """Adds a load between two markers that is computed by a Python function, for prototypes.
        It is called at every evaluation of the equations of motion, which takes about ten
        microseconds each. A table [[function_force]] does the same with formulas, and is faster.

        function: takes the time (s) and the motion of the marker `upper` relative to the moving
            frame of the marker `lower`, in its axes: position (3,) m, velocity (3,) m/s, rotation (3, 3)
            upper's axes to lower's, and angular velocity (3,) rad/s. Returns the force (3,) N and
            the moment (3,) N m that act on upper's body at upper's origin, in lower's axes; the
            opposite acts on lower's body at that point. It is also called along each step, at
            intervals of solver.resolution, so that no longer feature is missed. An exception
            that it raises ends the run.
        Returns this model, which has changed.
        """
        if name in self._functions:
            raise InputError(f"function_force '{name}': there is already one with this name")
        if not callable(function):
            raise InputError(f"function_force '{name}': expected a function, found {function!r}")
        self._data.add_function(name, lower, upper, function)
        self._functions[name] = (lower, upper, function)
        return self

    def simulate(self, folder: Path | None = None) -> Run:
        """Runs the model, as `flexneck simulate` does.

        folder: folder for the history and the table; default: results are kept in memory.
        Raises IncompleteRunError, with the results until then, if the run ends early.
        """
        name = pathlib.Path(self._path).stem
        if folder is not None:
            place = Folder(folder)
            warn(self._data.simulate_into(str(folder)))
            return Run(_core.read_run(place.file(name + ".h5")), place, name)
        data, problem = self._data.simulate()
        run = Run(data, None, name)
        warn(run.warnings)
        if problem:
            raise IncompleteRunError(problem, run)
        return run

    def export(self, path: Path) -> None:
        """Writes the model as an FMU 3.0 for co-simulation, with the extension .fmu, as `flexneck
        export` does. Raises InputError for a model with a Python function; use a
        [[function_force]] instead."""
        if pathlib.Path(path).suffix != ".fmu":
            raise InputError(f"{path}: expected the extension .fmu, the only format for models")
        warn(self._data.export_fmu(str(path)))

    @property
    def file(self) -> str:
        """The TOML file; for a dictionary the path that it would have."""
        return self._path

    @property
    def text(self) -> str:
        """The model as TOML, without settings and functions."""
        return pathlib.Path(self._path).read_text() if self._text is None else self._text

    @property
    def values(self) -> dict[str, Value]:
        """Every value that the model gives, by its dotted key."""
        return {key: Value(*rest) for key, *rest in self._data.parameters}

    def __repr__(self) -> str:
        return f"Model({self._path!r}, {self._settings!r})"
