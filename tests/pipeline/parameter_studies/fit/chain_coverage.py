#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""How often the error bars of 'flexneck fit' hold the truth, on the study of the neck's condensed
chain: figures of a pendulum run at known parameters, with noise, fitted again and again. Prints the
share for each parameter and leaves with 1 if it is too unlikely for bars of 95 %."""

import argparse
import csv
import json
import math
import pathlib
import random
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[4]
STUDY = ROOT / "pipeline/data/studies/hybrid3_chain.toml"
# Key, unit, bounds, start, truth.
PARAMETERS = {
    "damping": ("body.neck.damping_ratio", "", 0.3, 2, 1.2, 0.9),
    "head mass": ("body.head.mass", "lb", 7, 13, 11, 9.9),
}
CASE = "pendulum.flexion-60."
# Output, SI unit, standard deviation of its noise.
TARGETS = {
    "head_rotation": ("rad", 0.01),
    "neck_rotation": ("rad", 0.01),
    "base_moment": ("N*m", 3),
    "occipital_moment": ("N*m", 2),
    "head_rotation_time": ("s", 1e-3),
}


def run(program, *words):
    done = subprocess.run([program, *words, "-q"], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, words))}: {done.stderr}")


def parameter(table, name, values):
    key, unit = PARAMETERS[name][:2]
    text = f'[[{table}.parameter]]\nname = "{name}"\nkey = "{key}"\n'
    return text + (f'unit = "{unit}"\n' if unit else "") + values


def true_figures(program, out):
    outputs = [CASE + name for name in TARGETS]
    text = f'include = ["{STUDY}"]\n[sweep]\nplan = "list"\noutputs = {json.dumps(outputs)}\n'
    for name, row in PARAMETERS.items():
        text += parameter("sweep", name, f"values = [{row[5]}]\n")
    (out / "truth.toml").write_text(text)
    run(program, "sweep", out / "truth.toml", "-o", out / "truth")
    with open(out / "truth/sweep.csv", newline="", encoding="utf-8") as file:
        row = list(csv.reader(file))[1]
    first = 1 + len(PARAMETERS)
    return [float(text) for text in row[first:first + len(TARGETS)]]


def intervals(program, out, figures, noise):
    text = f'include = ["{STUDY}"]\n[fit]\nstarts = 1\n'
    for name, (_, _, low, high, start, _) in PARAMETERS.items():
        text += parameter("fit", name, f"from = {low}\nto = {high}\nstart = {start}\n")
    for (name, (unit, deviation)), figure in zip(TARGETS.items(), figures):
        value = figure + deviation * noise.gauss(0, 1)
        text += (f'[[fit.target]]\nname = "{name}"\noutput = "{CASE}{name}"\n'
                 f'value = "{value!r} {unit}"\nstandard_deviation = "{deviation} {unit}"\n')
    (out / "fit.toml").write_text(text)
    run(program, "fit", out / "fit.toml", "-o", out / "fit")
    tables = json.loads((out / "fit/fit.json").read_text())["tables"]
    rows = next(table for table in tables if table["name"] == "fit parameters")["rows"]
    return {row[0]: tuple(math.inf if cell == "open" else float(cell) for cell in row[3:5])
            for row in rows}


def tail(count, runs):
    """The probability of so few, or fewer, of so many runs."""
    return sum(math.comb(runs, k) * 0.95**k * 0.05**(runs - k) for k in range(count + 1))


def main():
    options = argparse.ArgumentParser()
    options.add_argument("program")
    options.add_argument("--seed", default="1")
    options.add_argument("--runs", type=int, default=50)
    options.add_argument("--out", type=pathlib.Path, required=True)
    given = options.parse_args()
    out = given.out.resolve()
    out.mkdir(parents=True, exist_ok=True)
    figures = true_figures(given.program, out)
    held = dict.fromkeys(PARAMETERS, 0)
    for k in range(given.runs):
        noise = random.Random(f"{given.seed} {k}")
        for name, (low, high) in intervals(given.program, out, figures, noise).items():
            truth = PARAMETERS[name][5]
            held[name] += (low == math.inf or low <= truth) and truth <= high
        print(k + 1, held, flush=True)
    sys.exit(any(tail(count, given.runs) < 1e-3 for count in held.values()))


if __name__ == "__main__":
    main()
