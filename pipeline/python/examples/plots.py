# SPDX-License-Identifier: GPL-3.0-or-later
"""The examples draw by matplotlib. Where it is not installed, the curves of each picture go into a
CSV file in its place, so that the examples run everywhere."""

import pathlib

import numpy as np

try:
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
except ImportError:
    plt = None


class Picture:
    """One picture: curves, names of the axes, a file."""

    def __init__(self, x_name, y_name):
        self._names, self._curves = (x_name, y_name), []

    def curve(self, x, y, label="", style="-"):
        x, y = np.asarray(x, dtype=float), np.asarray(y, dtype=float)
        if x.shape != y.shape or x.ndim != 1:
            raise ValueError(f"{label}: expected two curves of one length, found {x.shape}, {y.shape}")
        self._curves.append((x, y, label, style))

    def save(self, path):
        path = pathlib.Path(path)
        if plt is None:
            with open(path.with_suffix(".csv"), "w") as file:
                file.write("curve,{},{}\n".format(*self._names))
                for x, y, label, _ in self._curves:
                    file.writelines(f"{label},{a:.6g},{b:.6g}\n" for a, b in zip(x, y))
            print(f"{path.with_suffix('.csv')} (there is no matplotlib to draw {path.name})")
            return
        figure, axes = plt.subplots()
        for x, y, label, style in self._curves:
            axes.plot(x, y, style, label=label)
        axes.set_xlabel(self._names[0])
        axes.set_ylabel(self._names[1])
        if any(label for _, _, label, _ in self._curves):
            axes.legend()
        figure.savefig(path)
        plt.close(figure)
        print(path)
