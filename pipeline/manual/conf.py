# SPDX-License-Identifier: GPL-3.0-or-later
"""Of Sphinx: one page that holds its style and pictures, and nothing that runs."""

import base64
import mimetypes
import re
from pathlib import Path

project = "flexneck"
extensions = ["myst_parser"]
myst_enable_extensions = ["colon_fence"]
myst_heading_anchors = 2
exclude_patterns = ["sources"]
root_doc = "index"
html_theme = "basic"
html_title = "flexneck"
html_copy_source = False
html_show_sourcelink = False
html_show_copyright = False
html_permalinks = False
# READMEs link to files that are not part of the page.
suppress_warnings = ["myst.xref_missing", "myst.header", "toc.excluded"]

STYLE = """
body { font: 16px/1.5 system-ui, sans-serif; max-width: 60rem; margin: 2rem auto; padding: 0 1rem; color: #1b1f24 }
table { border-collapse: collapse; display: block; overflow-x: auto; margin: 1rem 0 }
th p, td p { margin: 0 } nav li { margin: .15rem 0 }
th, td { border: 1px solid #d0d7de; padding: .25rem .6rem; text-align: left; vertical-align: top }
pre { background: #f6f8fa; padding: .8rem; overflow-x: auto; font-size: .85rem; line-height: 1.35 }
math mtd { text-align: left; padding: .25rem 1.2rem .25rem 0 } math mtable mtable mtd { text-align: center; padding: .1rem .4rem }
div:has(> math) { overflow-x: auto; overflow-y: hidden; padding: .2rem 1rem } td math { white-space: nowrap }
code { font-size: .9em } img { max-width: 100% } a { color: #0550ae }
h1 { border-bottom: 1px solid #d0d7de; margin-top: 3rem }
.sphinxsidebar, .related, .footer { display: none }
@media (prefers-color-scheme: dark) {
  body { background: #0d1117; color: #e6edf3 } pre { background: #161b22 } a { color: #79c0ff }
  th, td, h1 { border-color: #30363d } img { background: #fff } }
@media print { body { max-width: none; font-size: 10pt } pre, table { overflow: visible; white-space: pre-wrap } }
"""


def picture(match, folder):
    path = (folder / match[2]).resolve()
    kind = mimetypes.guess_type(path.name)[0]
    return f'{match[1]}data:{kind};base64,{base64.b64encode(path.read_bytes()).decode()}"'


def contents_of(text):
    """A list of the chapters with the sections of each, as links; chapters share some names of sections, which have
    no place of their own then."""
    chapters = []
    for chapter, section, title in re.findall(
            r'<span id="(document-[^"]+)"></span>|<section id="([^"]+)">\s*(?:<span[^>]*></span>)*<h[23]>(.*?)</h', text):
        if chapter:
            chapters.append([])
        elif chapters and text.count(f'id="{section}"') == 1:
            chapters[-1].append(f'<a href="#{section}">{title}</a>')
    items = "".join(f"<li>{first}<ul>" + "".join(f"<li>{each}</li>" for each in rest) + "</ul></li>\n" if rest
                    else f"<li>{first}</li>\n" for first, *rest in filter(None, chapters))
    return f'<nav aria-label="Contents">\n<ul>\n{items}</ul>\n</nav>\n'


def put_into_one(app, error):
    """Style and pictures into the page, under its final name."""
    if error is not None or app.builder.name != "singlehtml":
        return
    folder = Path(app.outdir)
    text = (folder / "index.html").read_text()
    text = re.sub(r"<script[^>]*>.*?</script>\s*|<link [^>]*>\s*", "", text, flags=re.DOTALL)
    text = re.sub(r'(<img [^>]*?src=")(?!data:)([^"]+)"', lambda match: picture(match, folder), text)
    text = text.replace('href="index.html#', 'href="#')
    text = text.replace('<div class="toctree-wrapper', contents_of(text) + '<div class="toctree-wrapper', 1)
    text = text.replace("</head>", f"<style>{STYLE}</style>\n</head>")
    (folder / "flexneck.html").write_text(text)


def setup(app):
    app.connect("build-finished", put_into_one)
