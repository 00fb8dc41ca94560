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
    # SIGKILL cannot be handled: the lock and the temporary folder stay, whose lock the system
    # releases, and the hidden folder of an export.
    return [name for name in wrong
            if name != scenarios.LOCK and not name.startswith(("tmp/flexneck-", "out/.flexneck-"))]


def fault_of(scenario, by, end, found, again, mended):
    # METIS reports SIGTERM as an error of its own and continues.
    is_of_metis = by == signal.SIGTERM and end.status == 3 and "METIS" in end.text
    if end.status not in (0, 1, -by) and not is_of_metis:
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
