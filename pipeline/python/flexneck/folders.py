# SPDX-License-Identifier: GPL-3.0-or-later
"""Folders of results, and the commands that work in them."""

from __future__ import annotations

import os
import pathlib
import tempfile
import typing

from . import _core
from .errors import warn

Path = typing.Union[str, "os.PathLike[str]"]


class Folder:
    """A folder of results: the one that is named, or one of its own that goes with this object."""

    def __init__(self, path: Path | None) -> None:
        self._temporary = tempfile.TemporaryDirectory(prefix="flexneck-") if path is None else None
        named = self._temporary.name if self._temporary else typing.cast(Path, path)
        self.path = pathlib.Path(named).absolute()

    def file(self, name: str) -> str:
        return str(self.path / name)


def execute(command: str, folder: Folder, files: list[str], settings: list[str],
            **options: typing.Any) -> bool:
    """Does a command of `flexneck`, its warnings become Python's. Whether no verification failed."""
    passed, warnings = _core.execute(command, files, settings, str(folder.path), **options)
    warn(warnings)
    return bool(passed)
