# SPDX-License-Identifier: GPL-3.0-or-later
"""What the READMEs tell users to type: their commands, the studies that they show, their Python."""

import re
from dataclasses import dataclass, field

PROGRAMS = (r"(?:[A-Z_]+=\S+ )*(?:(?:build/)?flexneck(?= [a-z-])|mpirun|parallel|/usr/bin/time|sh|python3|"
            r"cmake|ctest|ccx|git|apt)(?= |$)")
# Placeholders for the reader's own names: MODEL.toml, [RUNS], …; such a command is not run.
SYNOPSIS = re.compile(r"\[[A-Z-]|…|\b[A-Z]{3,}\.(?:toml|csv|h5)\b")


@dataclass
class Readme:
    path: str
    commands: list = field(default_factory=list)
    files: dict = field(default_factory=dict)  # name of a study to its text
    python: list = field(default_factory=list)


def blocks_of(text):
    """Indented or fenced, as lists of lines without their margin."""
    for fenced in re.findall(r"^```\w*\n(.*?)^```$", text, re.MULTILINE | re.DOTALL):
        yield fenced.splitlines()
    text = re.sub(r"^```\w*\n.*?^```$", "", text, flags=re.MULTILINE | re.DOTALL)
    block = []
    for line in text.splitlines() + [""]:
        if line.startswith("    "):
            block.append(line[4:])
        elif line.strip() or not block:
            if block:
                yield block
            block = []
        else:
            block.append("")


def read(path, root):
    readme = Readme(str(path.relative_to(root)))
    for block in blocks_of(path.read_text()):
        commands = [line for line in block if re.match(PROGRAMS, line)]
        readme.commands += [line for line in commands if not SYNOPSIS.search(line)]
        text = "\n".join(line for line in block if line not in commands).strip()
        named = re.match(r"# (\w+\.toml)\n", text)
        if named:
            readme.files[named[1]] = text
        elif text.startswith("import "):
            readme.python.append(text)
    return readme


def readmes(root):
    """All of the project's, and what the heads of shipped files say, as one."""
    paths = [path for path in sorted(root.rglob("*.md"))
             if not any(part.startswith(("build", "out", ".")) for part in path.relative_to(root).parts)]
    found = [read(path, root) for path in paths]
    known = {command for readme in found for command in readme.commands}
    heads = Readme("heads of shipped files")
    for folder in ("pipeline/data/studies", "pipeline/data/studies/fits", "pipeline/data/models", "geometry/examples"):
        for path in sorted((root / folder).glob("*.toml")):
            for command in re.findall(rf"^#   ({PROGRAMS}.*)$", path.read_text(), re.MULTILINE):
                if command not in known | set(heads.commands) and not SYNOPSIS.search(command):
                    heads.commands.append(command)
    return [readme for readme in found + [heads] if readme.commands or readme.python]
