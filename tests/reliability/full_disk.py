# SPDX-License-Identifier: GPL-3.0-or-later
"""The disk is full, or a file may not grow further."""

import os
import random
import resource
import subprocess
import tempfile

import scenarios


def prepare(_options, made):
    """Each command on a disk and under a limit."""
    ways = ["limit"] + (["disk"] if can_mount() else [])
    return [(scenario, way) for scenario in made for way in ways]


def can_mount():
    with tempfile.TemporaryDirectory(prefix="disk-") as folder:
        if mount(folder, 1 << 20):
            unmount(folder)
            return True
    print("no disk can be made here (that takes root): only limits of the size of a file")
    return False


def mount(folder, size):
    command = ["mount", "-t", "tmpfs", "-o", f"size={size}", "tmpfs", folder]
    return subprocess.run(command, capture_output=True, check=False).returncode == 0


def unmount(folder):
    subprocess.run(["umount", folder], check=True)


def size_of(folder):
    """Bytes of whole pages."""
    total = 0
    for place, folders, files in os.walk(folder):
        total += 4096 * len(folders)
        total += sum(-(-os.path.getsize(os.path.join(place, name)) // 4096) * 4096 for name in files)
    return total


def fault_of(scenario, end, found):
    if end.status == "hang" or end.status not in (0, 1, 2, 3):
        return f"status {end.status}"
    if end.status in (2, 3):
        if not end.is_one_line(scenario):
            return "not one line"
        wrong = scenarios.differences(found, scenarios.either(scenario))
    else:
        wrong = scenarios.differences(found, scenarios.exactly(scenario.after))
    return f"exit {end.status} and " + ", ".join(wrong) if wrong else ""


def on_small_disk(options, scenario, room, base):
    """A disk with room for what is there and a little more."""
    disk = os.path.join(base, "disk")
    os.mkdir(disk)
    if not mount(disk, size_of(scenario.folder) + 4096 * (2 + room // 4096)):
        raise RuntimeError("mount")
    try:
        work = os.path.join(disk, "work")
        scenarios.copy(scenario, work)
        end = scenarios.run(options.program, scenario.arguments, work)
        return end, scenario.hashes(work)
    finally:
        unmount(disk)


def under_limit(options, scenario, size, base):
    work = os.path.join(base, "work")
    scenarios.copy(scenario, work)
    end = scenarios.run(options.program, scenario.arguments, work,
                        prepare=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (size, size)))
    return end, scenario.hashes(work)


def try_one(task):
    options, (scenario, way), seed = task
    generator = random.Random(seed)
    largest = 2 * size_of(os.path.join(scenario.folder, "out"))
    size = int(largest ** generator.uniform(0.2, 1.0))
    with tempfile.TemporaryDirectory(prefix="full-") as base:
        run = on_small_disk if way == "disk" else under_limit
        end, found = run(options, scenario, size, base)
    return {"name": f"{scenario.name}, {way}", "seed": seed, "what": f"{size} bytes",
            "reached": end.status in (2, 3), "status": end.status, "text": end.text[-600:],
            "fault": fault_of(scenario, end, found)}
