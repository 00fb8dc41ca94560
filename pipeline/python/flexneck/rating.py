# SPDX-License-Identifier: GPL-3.0-or-later
"""Ratings of curves, and units."""

from __future__ import annotations

import typing

import numpy as np

from . import _core
from .errors import InputError

if typing.TYPE_CHECKING:
    import numpy.typing as npt


def iso18571(reference: npt.ArrayLike, computed: npt.ArrayLike) -> dict[str, float]:
    """Rates a curve against a reference by ISO/TS 18571:2024.

    reference, computed: (n,) at the same times at 10 kHz, in the same unit, at least 100 samples.
    Returns ratings from 0 to 1: overall, corridor, phase, magnitude, slope; and shift, the samples
    by which the computed curve is late. Raises InputError for curves that cannot be rated.
    """
    return dict(_core.iso18571(_curve(reference), _curve(computed)))


def cora(reference: npt.ArrayLike, computed: npt.ArrayLike) -> dict[str, float]:
    """Rates a curve against a reference by CORA, with the parameters of its version 4.0.5.

    reference, computed: (n,) at the same equidistant times of the interval of evaluation, in the
        same unit, at least 100 samples.
    Returns ratings from 0 to 1: overall, corridor, progression, size, phase; and shift, the samples
    by which the computed curve is late. Raises InputError for curves that cannot be rated.
    """
    return dict(_core.cora(_curve(reference), _curve(computed)))


def nij(force_z: npt.ArrayLike, moment_y: npt.ArrayLike, interval: float,
        is_filtered: bool = False, dummy: str = "50th-male") -> dict[str, tuple[float, float]]:
    """Neck injury criterion Nij (49 CFR 571.208) of loads at the occipital condyles, with the
    signs of SAE J211.

    force_z: (n,), N, tension positive. moment_y: (n,), N m, flexion positive. interval: sampling
    interval, s. is_filtered: both are already filtered with CFC 600; otherwise they are
    filtered. dummy: "50th-male" or "5th-female".
    Returns the largest value (1) and its time (s) for each of NTE, NTF, NCE and NCF.
    """
    return dict(_core.nij(_curve(force_z), _curve(moment_y), interval, is_filtered, dummy))


def quantity(text: str, unit: str) -> float:
    """Converts a number with its unit to SI units: quantity("0.4 in", "m") is 0.01016. Raises
    InputError for an unknown unit or one of another dimension."""
    return float(_core.parse_quantity(text, unit))


def factor(unit: str, to: str) -> float:
    """Factor that converts a value in an SI unit to another unit: factor("rad", "deg")."""
    return float(_core.factor_from_si(unit, to))


def _curve(values: npt.ArrayLike) -> npt.NDArray[np.float64]:
    try:
        curve = np.ascontiguousarray(values, dtype=float)
    except (TypeError, ValueError) as error:
        raise InputError(f"expected the numbers of a curve: {error}") from None
    if curve.ndim != 1:
        raise InputError(f"expected a curve of the shape (n,), found {curve.shape}")
    return curve
