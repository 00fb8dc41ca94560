# SPDX-License-Identifier: GPL-3.0-or-later
"""One call of the system fails, or all from there on: fault_shim.cpp."""

import errno
import os
import random
import re
import struct
import tempfile

import scenarios

PAGE = 4096
KINDS = ["open", "write", "pwrite", "read", "pread", "close", "sync", "truncate", "rename", "link",
         "lock", "folder", "memory", "memory512", "memory8k", "memory128k"]
SHORT = 0
# Errors that a call of each kind may report. A call that is interrupted or does less has to be
# continued.
TRANSFER = [errno.ENOSPC, errno.EIO, errno.EINTR, SHORT]
ERRORS = {"write": TRANSFER, "pwrite": TRANSFER, "read": [errno.EIO, errno.EINTR, SHORT],
          "pread": [errno.EIO, errno.EINTR, SHORT], "open": [errno.ENOSPC, errno.EIO, errno.EMFILE],
          "sync": [errno.ENOSPC, errno.EIO, errno.EINTR], "close": [errno.EIO, errno.EINTR],
          "truncate": [errno.ENOSPC, errno.EIO, errno.EINTR], "lock": [errno.ENOLCK, errno.EINTR],
          "rename": [errno.ENOSPC, errno.EIO], "link": [errno.ENOSPC, errno.EIO],
          "folder": [errno.ENOSPC, errno.EIO]}
OURS = ("flexneck", "exe", "")  # as the stack names the program and its child
# Relative frequencies with which kinds are drawn.
WEIGHTS = {"pwrite": 4, "close": 2, "sync": 2, "rename": 2, "link": 2, "open": 3, "memory": 5,
           "memory512": 3, "memory8k": 2}


class Note:
    """What the shim counts and where the first fault was."""

    def __init__(self, path):
        self.path = path
        with open(path, "wb") as file:
            file.write(bytes(PAGE))

    def read(self):
        with open(self.path, "rb") as file:
            page = file.read()
        values = struct.unpack_from(f"<{len(KINDS) + 1}Q", page)
        stack = page[8 * len(values):].split(b"\0", 1)[0].decode()
        return dict(zip(KINDS, values)), values[-1], stack


def variables(shim, note, folder, plan=None):
    plan = plan or {"kind": "", "at": 0, "error": 0, "lasts": 0}
    return {"LD_PRELOAD": shim, "FAULT_NOTE": note.path, "FAULT_FOLDER": folder,
            **{"FAULT_" + key.upper(): str(value) for key, value in plan.items()}}


def count(program, shim, scenario):
    """How often an undisturbed run calls each kind; the shim alone may change nothing."""
    with tempfile.TemporaryDirectory(prefix="count-") as base:
        work = os.path.join(base, "work")
        scenarios.copy(scenario, work)
        note = Note(os.path.join(base, "note"))
        end = scenarios.run(program, scenario.arguments, work, variables(shim, note, work))
        wrong = scenarios.differences(scenario.hashes(work), scenarios.exactly(scenario.after))
        counts, _, _ = note.read()
        if end.status not in (0, 1) or wrong or counts["memory"] == 0 or counts["open"] == 0:
            raise SystemExit(f"{scenario.name} with the shim: {end} {wrong} {counts}")
    return counts


def draw(generator, counts, wanted):
    """A fault that an undisturbed run would meet."""
    kinds = [kind for kind in KINDS if counts[kind] and kind.startswith(wanted)]
    kind = generator.choices(kinds, [WEIGHTS.get(kind, 1) for kind in kinds])[0]
    number = counts[kind]
    # Early calls are drawn as often as late ones among the thousands that allocate memory.
    place = int(number ** generator.random()) if kind == "memory" else generator.randint(1, number)
    error = generator.choice(ERRORS.get(kind, [errno.ENOMEM]))
    lasts = error not in (errno.EINTR, SHORT) and generator.random() < 0.3
    return {"kind": kind, "at": place, "error": error, "lasts": int(lasts)}


def told(plan):
    name = "short" if plan["error"] == SHORT else errno.errorcode[plan["error"]]
    return f"{plan['kind']} {plan['at']} {name}" + (" and on" if plan["lasts"] else "")


def where(stack):
    """The library and its function that was refused memory last, without those that hand it on."""
    for line in stack.splitlines():
        name, function, _ = line.split(" ")
        if not re.match(r"(libc|libstdc\+\+|ld-linux|fault_shim)[.-]", name):
            return name, function
    return "", ""


def is_ended_by_mpi(end):
    """MPI ends the process by the system's call, with the class of its error: any of 1 to 92, 1 where it
    finds no way to send messages."""
    if end.status == "hang" or end.status <= 0:
        return False
    return "MPI_ERRORS_ARE_FATAL" in end.text or (
        end.status == 1 and re.search(r"PML \w+ cannot be selected", end.text) is not None)


def is_librarys_end(scenario, end, plan, library):
    """Whether a library may have ended the command that was refused memory: by a signal, or with
    lines of its own."""
    return plan["kind"].startswith("memory") and library not in OURS and \
        (end.status in (-6, -11) or (end.status == 3 and not end.is_one_line(scenario)) or
         is_ended_by_mpi(end))


def fault_of(scenario, end, found, plan, reached, library):
    """What is wrong with how a disturbed command ended; empty if nothing is."""
    if is_librarys_end(scenario, end, plan, library):
        wrong = [name for name in scenarios.differences(found, scenarios.either(scenario))
                 if not scenarios.left_by_a_crash(name)]
        return f"status {end.status} and " + ", ".join(wrong) if wrong else ""
    if end.status in (0, 1) and "Warning: " in end.text and ": gmsh: " in end.text:
        return ""  # another mesh, and it is told
    if end.status == "hang" or end.status not in (0, 1, 2, 3):
        return f"status {end.status}"
    if end.status in (2, 3):
        if not end.is_one_line(scenario):
            return "not one line"
        if plan["error"] in (errno.EINTR, SHORT) or not reached:
            return f"exit {end.status}"
        wrong = scenarios.differences(found, scenarios.either(scenario))
    else:
        wrong = scenarios.differences(found, scenarios.exactly(scenario.after))
    if plan["kind"] == "open":  # the content of a folder cannot be found if it cannot be opened
        wrong = [name for name in wrong if not name.startswith("tmp/flexneck-")]
    return f"exit {end.status} and " + ", ".join(wrong) if wrong else ""


def prepare(options, made):
    return [(scenario, count(options.program, options.shim, scenario)) for scenario in made]


def try_one(task):
    options, (scenario, counts), seed = task
    plan = draw(random.Random(seed), counts, tuple(options.kinds.split(",")))
    with tempfile.TemporaryDirectory(prefix="fault-") as base:
        work = os.path.join(base, "work")
        scenarios.copy(scenario, work)
        note = Note(os.path.join(base, "note"))
        end = scenarios.run(options.program, scenario.arguments, work,
                            variables(options.shim, note, work, plan))
        _, reached, stack = note.read()
        found = scenario.hashes(work)
    library, function = where(stack)
    fault = fault_of(scenario, end, found, plan, reached, library)
    return {"name": scenario.name, "seed": seed, "what": told(plan), "kind": plan["kind"],
            "reached": bool(reached), "status": end.status, "text": end.text[-600:],
            "fault": fault, "stack": stack,
            "library": f"{library} {function}" if is_librarys_end(scenario, end, plan, library) else ""}
