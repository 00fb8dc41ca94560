# SPDX-License-Identifier: GPL-3.0-or-later
"""What is raised, and what is warned of."""

from __future__ import annotations

import typing
import warnings

if typing.TYPE_CHECKING:
    from .run import Run


class Error(Exception):
    """Whatever flexneck raises on purpose."""


class InputError(Error, ValueError):
    """What was given cannot be used: an argument, a study, a model, a file. The text is one line:
    where, what was expected, what was found, what to do."""


class ComputationError(Error, RuntimeError):
    """A computation on sound input failed, or its results could not be written."""


class IncompleteRunError(ComputationError):
    """A run that could not go on. `run` has what was computed until then."""

    run: Run

    def __init__(self, text: str, run: Run) -> None:
        super().__init__(text)
        self.run = run


class ResultWarning(UserWarning):
    """A result may not be what it seems."""


class VerificationWarning(ResultWarning):
    """A computed figure is further from its published one than its tolerance."""


def warn(lines: list[str]) -> None:
    """Warns of each line, as of the code that called flexneck."""
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
