# SPDX-License-Identifier: GPL-3.0-or-later
"""Studies: everything that the neck, its modes and its experiments are made from."""

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
    """The names of the studies and models that come with flexneck, such as "hybrid3"."""
    return list(_core.shipped_names())


class Study(HasSettings):
    """A study: a shipped one by its name ("hybrid3", the default), or a TOML file.

    Raises InputError with file, line and key for what is not right in it. `flexneck keys study`
    tells all keys with their units.
    """

    def __init__(self, study: Path = "hybrid3", settings: typing.Sequence[str] = ()) -> None:
        self._file = os.path.abspath(_core.named_file(str(study)))
        self._settings = checked(settings)
        self._read()

    def _read(self) -> None:
        self._content = _core.study(self._file, self._settings)

    def set(self, key: str, value: typing.Any) -> Study:
        """Gives a key another value, as `--set key=value` of the command line does.

        key: dotted, such as "geometry.plate_thickness" or "case.flexion-60.duration".
        value: a text with its unit ("0.4 in"), a number, True or False, or a list.
        Returns this study, which has changed. Raises InputError, and leaves it as it was, for a key
        that there is not or a value that it cannot have.
        """
        self._set(key, value)
        return self

    def copy(self) -> Study:
        """Another study of the same values, which can be set apart from this one."""
        other = copy.copy(self)
        other._settings = list(self._settings)
        return other

    @property
    def file(self) -> str:
        """The TOML file."""
        return self._file

    @property
    def settings(self) -> list[str]:
        """What was set: "key=value"."""
        return list(self._settings)

    @property
    def values(self) -> dict[str, Value]:
        """Every value that the study gives, by its dotted key."""
        return {key: Value(*rest) for key, *rest in self._content["values"]}

    @property
    def defaults(self) -> dict[str, Value]:
        """What holds for keys that the study does not give."""
        return {key: Value(*rest) for key, *rest in self._content["defaults"]}

    @property
    def cases(self) -> dict[str, str]:
        """The experiments by their names: "pendulum" or "static"."""
        return dict(self._content["cases"])

    @property
    def tests(self) -> list[str]:
        """The certification tests that its cases are judged by."""
        return list(self._content["tests"])

    def mesh(self, folder: Path | None = None) -> Mesh:
        """Meshes the geometry, as `flexneck mesh` does.

        folder: for the results; none: a temporary one that goes with what is computed in it.
        """
        place = Folder(folder)
        execute("mesh", place, [self._file], self._settings)
        return Mesh(_core.read_mesh(place.file("mesh.h5")), self, place)

    def run(self, folder: Path | None = None, redo: bool = False) -> Results:
        """Mesh, modes, pictures, experiments, verification and report, as `flexneck run` does. A
        folder that has some of it is brought up to date; redo: all of it is done anew."""
        return self._done("run", folder, redo=redo)

    def qualify(self, folder: Path | None = None, redo: bool = False) -> Results:
        """The neck's certification test, as `flexneck qualify` does: all of run(), and every figure
        of the verdicts. For a study with tests, such as "hybrid3_qualification"."""
        return self._done("qualify", folder, redo=redo)

    def sweep(self, folder: Path, threads: int = 0) -> Results:
        """Many values of some keys, and what becomes of them: the study's [sweep], as `flexneck
        sweep` does. Rows are kept as they come: after Ctrl-C the same call goes on with the rest.

        threads: that compute rows; 0: all processors.
        """
        return self._done("sweep", folder, threads=threads)

    def fit(self, folder: Path, threads: int = 0) -> Results:
        """Free values that bring results to targets: the study's [fit], as `flexneck fit` does.
        What is done is kept: after Ctrl-C the same call goes on with the rest.

        threads: that compute; 0: all processors.
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
