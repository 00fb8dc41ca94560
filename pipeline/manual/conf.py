# SPDX-License-Identifier: GPL-3.0-or-later
"""Of Sphinx: pages with side bar and search that need no network."""

import os
import re
import sys
from pathlib import Path

project = "flexneck"
html_title = f"{project} manual"
extensions = ["myst_parser", "sphinx.ext.mathjax", "sphinx.ext.autodoc", "breathe"]
exclude_patterns = ["theory/run", "_static"]

myst_enable_extensions = ["dollarmath", "colon_fence"]
myst_heading_anchors = 4
suppress_warnings = ["myst.header"]

# Formulas by the copy of MathJax 2 that make_manual.py puts into _static.
html_static_path = ["_static"]
mathjax_path = "mathjax/MathJax.js?config=TeX-AMS_SVG"
myst_update_mathjax = False
mathjax2_config = {
    "showMathMenu": False,
    "messageStyle": "none",
    "tex2jax": {"inlineMath": [["\\(", "\\)"]], "displayMath": [["\\[", "\\]"]], "processEscapes": True,
                "processClass": "math"},
    "SVG": {"font": "TeX", "scale": 95},
}

html_theme = "sphinx_rtd_theme"
html_theme_options = {"navigation_depth": 3, "collapse_navigation": False}
html_css_files = ["manual.css"]
html_copy_source = False
html_show_sourcelink = False
html_show_copyright = False

autodoc_member_order = "bysource"
autodoc_typehints = "signature"
if not any(list(Path(folder, "flexneck").glob("_core*.so")) for folder in sys.path):
    autodoc_mock_imports = ["flexneck._core"]  # the package is not built: its texts are there all the same

breathe_projects = {project: os.environ.get("FLEXNECK_DOXYGEN", "")}
breathe_default_project = project
cpp_maximum_signature_line_length = 100


def readable(app, what, name, obj, options, lines):
    """Docstrings are plain text: "name: meaning" is an item of a list, and `name` is code."""
    made, is_item = [], False
    for line in lines:
        line = re.sub(r"(?<!`)`([^`]+)`(?!`)", r"``\1``", line).replace("|", r"\|")
        item = re.match(r"([a-z_]\w*(?:, [a-z_]\w*)*): (.*)", line)
        if item:
            made += [""] * (not is_item) + [f"- *{item[1]}*: {item[2]}"]
            is_item = True
        elif is_item and line.startswith("    "):
            made.append("  " + line.strip())
        else:
            made += [""] * is_item + [line]
            is_item = False
    lines[:] = made + [""]


def setup(app):
    app.connect("autodoc-process-docstring", readable)
