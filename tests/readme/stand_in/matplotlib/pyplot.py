# SPDX-License-Identifier: GPL-3.0-or-later
"""In the place of matplotlib where READMEs are tested: takes what matplotlib would take."""

import numpy


def plot(x, y):
    x, y = numpy.asarray(x, dtype=float), numpy.asarray(y, dtype=float)
    if x.shape[0] != y.shape[0] or not (numpy.isfinite(x).all() and numpy.isfinite(y).all()):
        raise ValueError(f"cannot draw {x.shape} over {y.shape}")
