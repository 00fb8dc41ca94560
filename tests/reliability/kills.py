# SPDX-License-Identifier: GPL-3.0-or-later
"""A signal ends a command at some moment: nothing is damaged, and running it again mends all."""

import os
import random
import signal
import tempfile
import time

import scenarios

SIGNALS = [signal.SIGKILL, signal.SIGTERM, signal.SIGINT]


def prepare(_options, made):
    return made


def left_behind(scenario, found, by):
    """What is neither as before nor as an undisturbed run leaves it."""
    expected = scenarios.either(scenario)
    wrong = scenarios.differences(found, expected)
    if by != signal.SIGKILL:
        return wrong
    return [name for name in wrong if not scenarios.left_by_a_crash(name)]


def fault_of(scenario, by, end, found, again, mended):
    if end.status not in (0, 1, -by):
        return f"status {end.status}"
    wrong = left_behind(scenario, found, by)
    if wrong:
        return f"left {', '.join(wrong)}"
    if again.status not in (0, 1):
        return f"again: status {again.status}"
    wrong = left_behind(scenario, mended, by)
    wrong += [name for name, value in scenario.after.items() if mended.get(name) != value]
    return f"again: {', '.join(wrong)}" if wrong else ""


def try_one(task):
    options, scenario, seed = task
    generator = random.Random(seed)
    by = generator.choice(SIGNALS)
    moment = generator.uniform(0, 1.1) * scenario.seconds
    with tempfile.TemporaryDirectory(prefix="kill-") as base:
        work = os.path.join(base, "work")
        scenarios.copy(scenario, work)
        process = scenarios.start(options.program, scenario.arguments, work)
        time.sleep(moment)
        process.send_signal(by)
        end = scenarios.end_of(process)
        found = scenario.hashes(work)
        again = scenarios.run(options.program, scenario.arguments, work)
        mended = scenario.hashes(work)
    return {"name": scenario.name, "seed": seed, "what": f"{by.name} after {moment:.3f} s",
            "reached": end.status == -by, "status": end.status,
            "text": end.text[-300:] + again.text[-300:],
            "fault": fault_of(scenario, by, end, found, again, mended)}
