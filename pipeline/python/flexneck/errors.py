# SPDX-License-Identifier: GPL-3.0-or-later
"""Exceptions and warnings."""

from __future__ import annotations

import typing
import warnings

if typing.TYPE_CHECKING:
    from .run import Run


class Error(Exception):
    """Base class of all exceptions that flexneck raises intentionally."""


class InputError(Error, ValueError):
    """Invalid input: an argument, a study, a model or a file. The message is one line that says
    where, what was expected, what was found and what to do."""


class ComputationError(Error, RuntimeError):
    """A computation with valid input failed, or its results could not be written."""


class IncompleteRunError(ComputationError):
    """A run ended early. `run` contains the results up to that time."""

    run: Run

    def __init__(self, text: str, run: Run) -> None:
        super().__init__(text)
        self.run = run


class ResultWarning(UserWarning):
    """A result may be unreliable."""


class VerificationWarning(ResultWarning):
    """A computed figure deviates from the published one by more than its tolerance."""


def warn(lines: list[str]) -> None:
    """Issues a warning for each line, attributed to the code that called flexneck."""
    level = 2
    while _is_ours(level):
        level += 1
    for line in lines:
        warnings.warn(line, ResultWarning, stacklevel=level)


def _is_ours(level: int) -> bool:
    import sys
    try:
        return sys._getframe(level).f_globals.get("__name__", "").startswith("flexneck.")
    except ValueError:
        return False
