# SPDX-License-Identifier: GPL-3.0-or-later
"""Studies: the inputs of the neck, its modes and its experiments."""

from __future__ import annotations

import copy
import os
import typing
import warnings

from . import _core
from .errors import VerificationWarning
from .folders import Folder, Path, execute
from .mesh import Mesh
from .results import Results
from .settings import HasSettings, checked
from .values import Value


def shipped_names() -> list[str]:
    """Names of the studies and models that are shipped with flexneck, such as "hybrid3"."""
    return list(_core.shipped_names())


class Study(HasSettings):
    """A study: a shipped one by its name ("hybrid3", the default), or a TOML file.

    Raises InputError with file, line and key for invalid input. `flexneck keys study` lists all
    keys with their units.
    """

    def __init__(self, study: Path = "hybrid3", settings: typing.Sequence[str] = ()) -> None:
        self._file = os.path.abspath(_core.named_file(str(study)))
        self._settings = checked(settings)
        self._read()

    def _read(self) -> None:
        self._content = _core.study(self._file, self._settings)

    def set(self, key: str, value: typing.Any) -> Study:
        """Sets the value of a key, as `--set key=value` of the command line does.

        key: dotted, such as "geometry.plate_thickness" or "case.flexion-60.duration".
        value: a text with its unit ("0.4 in"), a number, True or False, or a list.
        Returns this study, which has changed. Raises InputError for an unknown key or an invalid
        value, and leaves the study unchanged.
        """
        self._set(key, value)
        return self

    def copy(self) -> Study:
        """A copy of this study, whose values can be set independently."""
        other = copy.copy(self)
        other._settings = list(self._settings)
        return other

    @property
    def file(self) -> str:
        """The TOML file."""
        return self._file

    @property
    def settings(self) -> list[str]:
        """Settings of the study, as "key=value"."""
        return list(self._settings)

    @property
    def values(self) -> dict[str, Value]:
        """All values that the study gives, by dotted key."""
        return {key: Value(*rest) for key, *rest in self._content["values"]}

    @property
    def defaults(self) -> dict[str, Value]:
        """Default values of the keys that the study does not give."""
        return {key: Value(*rest) for key, *rest in self._content["defaults"]}

    @property
    def cases(self) -> dict[str, str]:
        """Kinds of the cases by name: "pendulum" or "static"."""
        return dict(self._content["cases"])

    @property
    def tests(self) -> list[str]:
        """Names of the certification tests of its cases."""
        return list(self._content["tests"])

    def mesh(self, folder: Path | None = None) -> Mesh:
        """Meshes the geometry, as `flexneck mesh` does.

        folder: for the results; none: a temporary one that goes with what is computed in it.
        """
        place = Folder(folder)
        execute("mesh", place, [self._file], self._settings)
        return Mesh(_core.read_mesh(place.file("mesh.h5")), self, place)

    def run(self, folder: Path | None = None, redo: bool = False) -> Results:
        """Runs mesh, modes, pictures, experiments, verification and report, as `flexneck run` does. Only
        outdated results in the folder are computed again; redo: all are computed again."""
        return self._done("run", folder, redo=redo)

    def qualify(self, folder: Path | None = None, redo: bool = False) -> Results:
        """Runs the certification test of the neck, as `flexneck qualify` does: all of run(), with
        every figure of the verdicts. For a study with tests, such as "hybrid3_qualification"."""
        return self._done("qualify", folder, redo=redo)

    def sweep(self, folder: Path, threads: int = 0) -> Results:
        """Runs the parameter sweep defined in [sweep] of the study, as `flexneck sweep` does.
        Completed rows are kept: after Ctrl-C the same call continues with the rest.

        threads: maximum number of threads; 0: all cores.
        """
        return self._done("sweep", folder, threads=threads)

    def fit(self, folder: Path, threads: int = 0) -> Results:
        """Fits parameters to targets, as defined in [fit] of the study, as `flexneck fit` does.
        Completed fits are kept: after Ctrl-C the same call continues with the rest.

        threads: maximum number of threads; 0: all cores.
        """
        return self._done("fit", folder, threads=threads)

    def _done(self, command: str, folder: Path | None, **options: typing.Any) -> Results:
        place = Folder(folder)
        passed = execute(command, place, [self._file], self._settings, **options)
        if not passed:
            warnings.warn("a verification failed: see Results.verification", VerificationWarning,
                          stacklevel=3)
        return Results(place)

    def __repr__(self) -> str:
        return f"Study({self._file!r}, {self._settings!r})"
