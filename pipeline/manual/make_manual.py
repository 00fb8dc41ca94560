#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the manual's site: the texts of this folder, and the pages that the program knows better.

Usage: make_manual.py FLEXNECK SOURCES OUT       (OUT/html/index.html)
"""

import importlib.util
import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
ENVIRONMENT = {**os.environ, "OMP_NUM_THREADS": "1"}
SPHINX = "/usr/bin/sphinx-build"
MATHJAX = Path("/usr/share/javascript/mathjax")
# What TeX as SVG takes of MathJax: its fonts are scripts, which a browser loads from a disk, too.
MATHJAX_PARTS = ["MathJax.js", "config/TeX-AMS_SVG.js", "jax/input/TeX", "jax/element", "jax/output/SVG/jax.js",
                 "jax/output/SVG/autoload", "jax/output/SVG/fonts/TeX", "extensions", "localization/en"]
# The page of each library, and the installed headers by which a program of one's own begins.
LIBRARIES = {
    "foundation": ("units, errors and files", [
        "geometry/foundation/units.h", "geometry/foundation/error.h", "geometry/foundation/provenance.h",
        "geometry/foundation/origin.h", "geometry/foundation/hdf5_file.h"]),
    "geometry": ("the neck's dimensions", ["geometry/neck/neck_parameters.h", "geometry/neck/neck_measures.h",
                                           "geometry/neck/neck_slits.h"]),
    "mesher": ("meshes", [
        "mesher/mesh/mesh.h", "mesher/mesh/element_kind.h", "mesher/mesh/connections.h", "mesher/mesh/mesh_file.h",
        "mesher/mesh/refinement.h", "mesher/partition/element_partition.h", "mesher/partition/node_order.h",
        "mesher/gmsh/mesh_import.h", "mesher/gmsh/script_mesher.h"]),
    "fe_modal": ("modes and static steps", [
        "fe_modal/system/modal_options.h", "fe_modal/system/loads.h", "fe_modal/analysis/modal_analysis.h",
        "fe_modal/analysis/static_analysis.h", "fe_modal/analysis/sensitivity.h", "fe_modal/body/modal_body.h",
        "fe_modal/body/modal_body_file.h", "fe_modal/body/static_solution.h"]),
    "multibody": ("bodies in motion", [
        "multibody/model/model.h", "multibody/joints/joint_kinds.h", "multibody/forces/force_kinds.h", "multibody/equations/solver_options.h", "multibody/history/output_options.h",
        "multibody/simulation/simulation.h", "multibody/simulation/stepped_run.h",
        "multibody/history/history.h", "multibody/analysis/linearisation.h", "multibody/analysis/steady_rotation.h",
        "multibody/analysis/campbell.h", "multibody/files/history_file.h", "multibody/signals/cfc_filter.h",
        "multibody/signals/load_cell.h"]),
}


def asked(flexneck, *words):
    return subprocess.run([flexneck, *words], check=True, text=True, stdout=subprocess.PIPE).stdout


def literal(text):
    return "```text\n" + text.rstrip() + "\n```\n"


def commands_page(flexneck):
    text = ("# Commands\n\nFor whoever types commands: what `flexneck --help` and `flexneck COMMAND --help` print.\n\n"
            + literal(asked(flexneck, "--help")))
    for name in re.findall(r"^  ([a-z]+)  ", asked(flexneck, "--help"), re.MULTILINE):
        text += f"\n## flexneck {name}\n\n" + literal(asked(flexneck, name, "--help"))
    return text


def keys_page(flexneck):
    """A section for each kind of file, one below it for each of its tables."""
    text = ("# Keys of all files\n\nFor authors of studies and models: every key, as `flexneck keys` prints them. Units and "
            "defaults are those that hold where a file says nothing.\n")
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


def validation_page(flexneck, folder):
    """What the built-in study comes to, beside what is published, and its figures."""
    run = folder / "run"
    subprocess.run([flexneck, "run", "-q", "-o", run], check=True, env=ENVIRONMENT, stderr=subprocess.PIPE)
    table = json.loads((run / "verification.json").read_text())
    text = ("# Beside the published figures\n\nFor readers of the paper: the built-in study beside the published figures, as "
            "the program that this manual goes with computed it.\n\n")
    text += "| quantity | how | computed | published | unit | error % | |\n|---|---|--:|--:|---|--:|---|\n"
    for row in table["rows"]:
        error = row.get("error_percent")
        words = [row["quantity"], row["detail"], row["value"], row["reference"], row["unit"],
                 "" if error is None else f"{error:+.2f}", " fitted" if row.get("fitted") else ""]
        text += "| " + " | ".join(str(word) for word in words) + " |\n"
    text += ("\n*fitted*: the neck's dimensions were fitted to this figure. Figures 1 to 16 are those of the paper by "
             "the numbers of its captions.\n")
    for picture in sorted((run / "figures").glob("*.svg")):
        text += f"\n![{picture.stem}](run/figures/{picture.name})\n"
    return text


def python_page(package):
    """By autodoc: of the compiled package, or of its sources alone."""
    listed = re.search(r"__all__ = \[(.*?)\]", (package / "__init__.py").read_text(), re.DOTALL)[1]
    names = [name for name in re.findall(r'"(\w+)"', listed) if name not in ("__version__", "git_hash")]
    text = ("# The Python package\n\nFor whoever programs in Python: every name of `flexneck`, from its docstring. The "
            "[guide](../guides/python.md) shows how they go together.\n\n```{eval-rst}\n.. currentmodule:: flexneck\n\n")
    for name in names:
        kind = "autoclass" if name[0].isupper() else "autofunction"
        kind = "autoexception" if name.endswith(("Error", "Warning")) else kind
        text += f".. {kind}:: {name}\n"
        text += "   :members:\n" if kind == "autoclass" else ""
    return text + "```\n"


def cpp_pages(reference):
    """By Doxygen and Breathe: a page for each library, of installed headers alone."""
    text = ("# The C++ libraries\n\nFor whoever programs in C++: the headers by which a program of one's own begins, a page for "
            "each library. [Install](../guides/install.md#use-the-libraries) says how they are linked; all installed "
            "headers have comments of this kind.\n\n```{toctree}\n")
    (reference / "cpp").mkdir()
    for name, (about, headers) in LIBRARIES.items():
        text += f"cpp/{name}\n"
        title = f"C++: {name}, {about}"
        # As reStructuredText: Breathe's warnings want its parser.
        page = f"{title}\n{'=' * len(title)}\n\nFor whoever programs in C++ with the library ``{name}``.\n"
        page += "Its first headers:\n\n" + "".join(f"- ``{header}``\n" for header in headers)
        space = "flexneck" if name == "foundation" else f"flexneck::{name}"
        page += f"\n.. doxygennamespace:: {space}\n   :content-only:\n"
        (reference / "cpp" / f"{name}.rst").write_text(page)
    (reference / "cpp.md").write_text(text + "```\n")


def doxygen(sources, out):
    headers = [sources / header for _, headers in LIBRARIES.values() for header in headers]
    settings = {"INPUT": " ".join(str(path) for path in headers), "OUTPUT_DIRECTORY": out, "GENERATE_XML": "YES",
                "GENERATE_HTML": "NO", "GENERATE_LATEX": "NO", "QUIET": "YES", "WARNINGS": "NO", "WARN_IF_INCOMPLETE_DOC": "NO",
                "WARN_IF_DOC_ERROR": "NO", "EXTRACT_ALL": "YES",
                "FULL_PATH_NAMES": "YES", "STRIP_FROM_PATH": sources, "XML_PROGRAMLISTING": "NO",
                "INPUT_FILTER": f'"sed -f {out}/one_exception.sed"'}
    out.mkdir(exist_ok=True)
    # Breathe takes one exception for each @throws.
    (out / "one_exception.sed").write_text(r"s/@throws as /Throws as /; s/\(@throws [A-Za-z]*\), /\1 or /" + "\n")
    subprocess.run(["doxygen", "-"], check=True, text=True, input="".join(f"{k} = {v}\n" for k, v in settings.items()))


def contents(index):
    """The side bar, from the lists of pages under the headings of the index."""
    text = ""
    for title, section in re.findall(r"^## ([^\n]*)\n(.*?)(?=^## |\Z)", index, re.MULTILINE | re.DOTALL):
        pages = [a or b for a, b in re.findall(r"^- (?:\[[^\]]+\]\(([\w/]+)\.md\)|`([\w/]+)`)", section, re.MULTILINE)]
        if pages:
            text += f"\n```{{toctree}}\n:caption: {title}\n:hidden:\n\n" + "".join(f"{page}\n" for page in pages) + "```\n"
    return text


def copied(source):
    """The texts of this folder, and MathJax beside them."""
    for path in HERE.rglob("*.md"):
        if path.name != "README.md":
            to = source / path.relative_to(HERE)
            to.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(path, to)
    index = (HERE / "index.md").read_text()
    linked = re.sub(r"^- (`[\w/]+`)", r"- {doc}\1", index, flags=re.MULTILINE)  # pages that are here alone
    (source / "index.md").write_text(linked + contents(index))
    shutil.copy(HERE / "conf.py", source)
    (source / "_static").mkdir()
    shutil.copy(HERE / "manual.css", source / "_static")
    for part in MATHJAX_PARTS:
        to = source / "_static/mathjax" / part
        to.parent.mkdir(parents=True, exist_ok=True)
        (shutil.copytree if (MATHJAX / part).is_dir() else shutil.copy)(MATHJAX / part, to)


def missing():
    """Packages of cmake/packages.txt without which there are no pages."""
    wanted = {"doxygen": shutil.which("doxygen"), "libjs-mathjax": MATHJAX.is_dir(), "python3-sphinx": shutil.which(SPHINX),
              **{f"python3-{name.replace('_', '-')}": importlib.util.find_spec(module)
                 for name, module in (("breathe", "breathe"), ("myst_parser", "myst_parser"),
                                      ("sphinx_rtd_theme", "sphinx_rtd_theme"))}}
    return [package for package, found in wanted.items() if not found]


def main():
    if missing():
        sys.exit(f"The manual needs {', '.join(missing())}: sh cmake/setup.sh manual")
    flexneck, sources, out = (Path(word).resolve() for word in sys.argv[1:4])
    source = out / "source"
    for folder in (source, out / "html"):
        shutil.rmtree(folder, ignore_errors=True)
    source.mkdir(parents=True)
    copied(source)
    # Texts name pictures from where they stand in the sources.
    if not (out / "data").is_symlink():
        (out / "data").symlink_to(sources / "pipeline/data")
    built = flexneck.parent / "python"
    package = built if built.is_dir() else sources / "pipeline/python"
    (source / "reference/commands.md").write_text(commands_page(flexneck))
    (source / "reference/keys.md").write_text(keys_page(flexneck))
    (source / "reference/python.md").write_text(python_page(package / "flexneck"))
    (source / "theory/validation.md").write_text(validation_page(flexneck, source / "theory"))
    cpp_pages(source / "reference")
    doxygen(sources, out / "doxygen")
    version = re.match(r"flexneck (\S+)", asked(flexneck, "--version"))[1]
    subprocess.run([SPHINX, "-q", "-b", "html", "-D", f"release={version}", source, out / "html"], check=True,
                   env={**ENVIRONMENT, "PYTHONPATH": str(package), "FLEXNECK_DOXYGEN": str(out / "doxygen/xml")})
    print(out / "html/index.html")


if __name__ == "__main__":
    main()
