# SPDX-License-Identifier: GPL-3.0-or-later
"""Two processes at once in one folder: the results are those of one after the other."""

import os
import random
import tempfile
import time

import scenarios


def prepare(options, made):
    """Pairs of commands in the same folder, with the results of each order."""
    pairs = []
    with tempfile.TemporaryDirectory(prefix="orders-") as base:
        for first in made:
            for second in made:
                if first.folder == second.folder and first.name <= second.name:
                    pairs.append((first, second, _orders(options.program, first, second, base)))
    return pairs


def _orders(program, first, second, base):
    """Results by what ran."""
    results = {"1": first.after, "2": second.after}
    for name, commands in (("12", (first, second)), ("21", (second, first))):
        work = os.path.join(base, f"{first.name}-{second.name}-{name}")
        scenarios.copy(first, work)
        ends = [scenarios.run(program, command.arguments, work) for command in commands]
        # One run may undo a requirement of the other; it must then report this.
        results[name] = first.hashes(work) if all(end.status in (0, 1) for end in ends) else None
    return results


def is_refused(command, end, other):
    return end.status == 2 and end.is_one_line(command) and "is in use by '" in end.text and \
        f"process {other} on " in end.text


def fault_of(first, second, ends, ids, results, found):
    done = "".join(name for name, end in zip("12", ends) if end.status in (0, 1))
    for command, end, other in zip((first, second), ends, reversed(ids)):
        if end.status not in (0, 1) and not is_refused(command, end, other):
            return f"status {end.status}"
    orders = ["12", "21"] if done == "12" else [done]
    expected = [results[order] for order in orders if results.get(order) is not None]
    if found in expected:
        return ""
    wrong = [scenarios.differences(found, scenarios.exactly(each)) for each in expected]
    return f"{first.name}, {second.name}: {done or 'none'} done and {wrong}"


def try_one(task):
    options, (first, second, results), seed = task
    generator = random.Random(seed)
    offset = generator.uniform(0, 1.2) ** 2 * first.seconds
    pair = [first, second]
    if generator.random() < 0.5:
        pair.reverse()
    with tempfile.TemporaryDirectory(prefix="race-") as base:
        work = os.path.join(base, "work")
        scenarios.copy(first, work)
        processes = [scenarios.start(options.program, pair[0].arguments, work)]
        time.sleep(offset)
        processes.append(scenarios.start(options.program, pair[1].arguments, work))
        ends = [scenarios.end_of(process) for process in processes]
        found = first.hashes(work)
    ids = [process.pid for process in processes]
    if pair[0] is not first:
        ends.reverse()
        ids.reverse()
    fault = fault_of(first, second, ends, ids, results, found)
    refused = [end for end in ends if end.status not in (0, 1)]
    return {"name": f"{first.name}, {second.name}", "seed": seed, "what": f"{offset:.3f} s",
            "reached": bool(refused), "status": max(str(end.status) for end in ends),
            "text": " | ".join(end.text[-300:] for end in refused), "fault": fault}
