# SPDX-License-Identifier: GPL-3.0-or-later
"""Values that results are made from."""

from __future__ import annotations

import typing


class Value(typing.NamedTuple):
    """A value of a study or a model, as text with its unit."""

    text: str
    """Such as "0.4 in"."""
    origin: str
    """published, inferred, calibrated or synthetic."""
    note: str
    """Source or reason; may be empty."""
