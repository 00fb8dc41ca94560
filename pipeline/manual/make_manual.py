#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the manual: asks the program for what it knows, runs the built-in study for the validation, and has
Sphinx put all of it into one page.

Usage: make_manual.py FLEXNECK SOURCES SPHINX-BUILD OUT       (OUT/flexneck.html)
"""

import json
import os
import re
import shutil
import subprocess
import sys
from html import escape
from pathlib import Path

import mathml

HERE = Path(__file__).resolve().parent
ENVIRONMENT = {**os.environ, "OMP_NUM_THREADS": "1"}

# The text of the manual: files of the sources, in the order of reading.
CHAPTERS = {
    "tour": ("A tour", ["README.md"]),
    "geometry": ("Geometry and mesh", ["geometry/README.md", "mesher/README.md"]),
    "modes": ("Modes", ["fe_modal/README.md"]),
    "multibody": ("Bodies in motion", ["multibody/README.md"]),
    "theory": ("Theory", ["multibody/CONVENTIONS.md", "multibody/equations.md"]),
    "models": ("Model files", ["pipeline/data/models/README.md"]),
    "experiments": ("Experiments, tests, ratings", ["pipeline/experiments/README.md", "pipeline/laboratory/verdict/README.md",
                                                    "pipeline/data/studies/README.md", "pipeline/laboratory/rating/README.md"]),
    "studies": ("Many values, free values", ["pipeline/parameter_studies/evaluation/README.md", "pipeline/parameter_studies/sampling/README.md",
                                             "pipeline/parameter_studies/sweep/README.md", "pipeline/parameter_studies/fit/README.md"]),
    "python": ("From Python", ["pipeline/python/README.md"]),
    "files": ("File formats", ["geometry/foundation/README.md", "mesher/mesh/README.md", "fe_modal/body/README.md",
                               "fe_modal/exchange/README.md", "pipeline/laboratory/iso_mme/README.md", "pipeline/exchange/fmu/README.md"]),
}


def asked(flexneck, *words):
    return subprocess.run([flexneck, *words], check=True, text=True, stdout=subprocess.PIPE).stdout


def literal(text):
    return "```text\n" + text.rstrip() + "\n```\n"


def label_of(path):
    return "text-" + re.sub(r"\W+", "-", path).strip("-").lower()


def included(sources, path):
    """A text of the sources as a section: headings one deeper, links to other texts kept, the rest as words."""
    texts = {each for _, files in CHAPTERS.values() for each in files}

    def link(match):
        target = os.path.normpath(os.path.join(os.path.dirname(path), match[3].partition("#")[0]))
        if match[3].startswith("http"):
            return match[0]
        if match[1]:
            return f"![{match[2]}](sources/{target})"
        if match[3].startswith("#"):
            return f"[{match[2]}]({label_of(path)})"
        return f"[{match[2]}]({label_of(target)})" if target in texts else match[2]

    text = (sources / path).read_text()
    text = typeset(text) if path == EQUATIONS else text
    text = re.sub(r"^(#+ )", r"#\1", text, flags=re.MULTILINE)
    text = re.sub(r"(!?)\[([^\]]+)\]\(([^)\s]+)\)", link, text)
    return f"({label_of(path)})=\n{text}\n"


# The text with equations, and the columns of its tables that hold some.
EQUATIONS = "multibody/equations.md"
EQUATION_COLUMNS = {"equation", "rows", "right-hand side", "position residual", "unit load", "matrix", "of chi_jl"}


def table_of_equations(lines):
    cells = [[cell.strip() for cell in line.strip().strip("|").split("|")] for line in lines]
    head, body = cells[0], cells[2:]
    html = "<table><thead><tr>" + "".join(f"<th>{cell}</th>" for cell in head) + "</tr></thead><tbody>"
    for row in body:
        html += "<tr>" + "".join(
            f"<td>{mathml.inline(cell) if name in EQUATION_COLUMNS else escape(cell)}</td>"
            for name, cell in zip(head, row)) + "</tr>"
    return html + "</tbody></table>"


def typeset(text):
    """Indented lines are equations, and so are cells of some tables; words stay as they are."""
    out, block = [], []

    def end():
        if block and block[0].startswith("    "):
            out.append(f"<div>{mathml.display(block)}</div>\n")
        elif block:
            is_math = EQUATION_COLUMNS & {cell.strip() for cell in block[0].split("|")}
            out.extend([table_of_equations(block) + "\n"] if is_math else block)
        block.clear()

    for line in text.splitlines():
        kind = line[:1] if line.startswith("|") else line[:4] if line.startswith("    ") else ""
        if block and not block[0].startswith(kind or "\0"):
            end()
        (block if kind else out).append(line)
    end()
    return "\n".join(out) + "\n"


def commands_chapter(flexneck):
    text = "# Commands\n\n" + literal(asked(flexneck, "--help"))
    for name in re.findall(r"^  ([a-z]+)  ", asked(flexneck, "--help"), re.MULTILINE):
        text += f"\n## flexneck {name}\n\n" + literal(asked(flexneck, name, "--help"))
    return text


def keys_chapter(flexneck):
    """A section for each kind of file, one below it for each of its tables."""
    text = "# Keys of all files\n\nUnits and defaults are those that hold where a file says nothing.\n"
    for block in asked(flexneck, "keys").strip().split("\n\n"):
        found = re.match(r"([a-z]+)  (\S.*)\n", block)
        if not found:
            continue
        kind = found[1]
        text += f"\n## {found[2]}\n"
        names = re.findall(r"^\[*([a-z_]+)\]*  ", block, re.MULTILINE)[1:]
        about = asked(flexneck, "keys", *(f"{kind}.{name}" for name in names))
        # One section for each table; keys outside tables stand between them.
        for part in re.split(r"\n\n(?=\[+\w+\]+ )|\n\n(?=  )|(?<=\n)\n(?=\[+\w+\]+ )", about):
            head, _, rest = part.strip("\n").partition("\n")
            is_table = head.startswith("[")
            title = re.sub(r"^(\[+[^\]]+\]+)", r"`\1`", head)
            text += f"\n### {title}\n\n" + literal(rest) if is_table else "\n" + literal(part.strip("\n"))
    return text


def validation_chapter(flexneck, folder):
    """What the built-in study comes to, beside what is published, and its figures."""
    run = folder / "run"
    subprocess.run([flexneck, "run", "-q", "-o", run], check=True, env=ENVIRONMENT)
    table = json.loads((run / "verification.json").read_text())
    text = "# Validation\n\nThe built-in study beside the published figures, as this program computed it:\n\n"
    text += "| quantity | how | computed | published | unit | error % | |\n|---|---|--:|--:|---|--:|---|\n"
    for row in table["rows"]:
        error = row.get("error_percent")
        words = [row["quantity"], row["detail"], row["value"], row["reference"], row["unit"],
                 "" if error is None else f"{error:+.2f}", " fitted" if row.get("fitted") else ""]
        text += "| " + " | ".join(str(word) for word in words) + " |\n"
    text += ("\n*fitted*: the neck's dimensions were fitted to this figure. Figures 1 to 16 are those of the paper by "
             "the numbers of its captions.\n")
    for picture in sorted((run / "figures").glob("*.svg")):
        text += f"\n![{picture.stem}]({picture.relative_to(folder)})\n"
    return text


def main():
    flexneck, sources, sphinx, out = (Path(word) for word in sys.argv[1:5])
    source = out / "source"
    shutil.rmtree(source, ignore_errors=True)
    source.mkdir(parents=True)
    for name in ("conf.py", "index.md", "cite.md"):
        shutil.copy(HERE / name, source)
    for name, (title, files) in CHAPTERS.items():
        (source / f"{name}.md").write_text(f"# {title}\n\n" + "\n".join(included(sources, path) for path in files))
    (source / "commands.md").write_text(commands_chapter(flexneck))
    (source / "keys.md").write_text(keys_chapter(flexneck))
    (source / "validation.md").write_text(validation_chapter(flexneck, source))
    # The sources contain the pictures.
    (source / "sources").symlink_to(sources)
    version = re.match(r"flexneck (\S+)", asked(flexneck, "--version"))[1]
    subprocess.run([sphinx, "-q", "-b", "singlehtml", "-D", f"release={version}", source, out / "html"], check=True)
    (out / "html" / "flexneck.html").replace(out / "flexneck.html")
    print(out / "flexneck.html")


if __name__ == "__main__":
    main()
