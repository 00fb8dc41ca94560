# SPDX-License-Identifier: GPL-3.0-or-later
"""Settings of a file, like `--set key=value` of the command line."""

from __future__ import annotations

import typing

from .errors import InputError
from .toml_text import setting


def checked(settings: typing.Sequence[str]) -> list[str]:
    """Checks that the settings are a list of "key=value", not a single text."""
    if isinstance(settings, str) or not all(isinstance(each, str) for each in settings):
        raise InputError(f'settings: expected a list such as ["modes.count=6"], found {settings!r}')
    return list(settings)


class HasSettings:
    """A file that is read with settings, and read again if they change."""

    _settings: list[str]

    def _read(self) -> None:
        raise NotImplementedError

    def _set(self, key: str, value: typing.Any) -> None:
        before = self._settings
        self._settings = [each for each in before if each.split("=", 1)[0] != key]
        self._settings.append(setting(key, value))
        try:
            self._read()
        except Exception:
            self._settings = before
            raise
