# SPDX-License-Identifier: GPL-3.0-or-later
"""Values that results are made from."""

from __future__ import annotations

import typing


def describe(fields_of: type, **texts: str) -> None:
    """Sets the texts that help() shows for the fields of a named tuple."""
    for name, text in texts.items():
        getattr(fields_of, name).__doc__ = text


class Value(typing.NamedTuple):
    """A value of a study or a model, as text with its unit."""

    text: str
    origin: str
    note: str


describe(
    Value,
    text="Value with its unit, such as \"0.4 in\".",
    origin="Origin: published, inferred, calibrated or synthetic.",
    note="Source or reason; may be empty.",
)
