# SPDX-License-Identifier: GPL-3.0-or-later
"""Relative links of Markdown files: what they lead to, and which lead nowhere."""

import re


def prose_of(text):
    """Without blocks and pieces of code, in which nothing is a link or a formula."""
    text = re.sub(r"^(`{3,}|:{3,}).*?^\1$", "", text, flags=re.MULTILINE | re.DOTALL)
    text = re.sub(r"^    .*$", "", text, flags=re.MULTILINE)
    return re.sub(r"(`+).+?\1", "code", text)


def anchors_of(text):
    """Of headings, as git hosts and MyST make them."""
    text = re.sub(r"^```.*?^```$", "", text, flags=re.MULTILINE | re.DOTALL)
    titles = re.findall(r"^#+ (.*)$", text, re.MULTILINE)
    return [re.sub(r"[^\w\- ]", "", title.strip().lower()).replace(" ", "-") for title in titles]


def links_of(path):
    """Pairs of a file and an anchor, which may be empty."""
    for target in re.findall(r"\]\(([^)\s]+)\)", prose_of(path.read_text())):
        if not re.match(r"[a-z]+:", target):
            name, _, anchor = target.partition("#")
            yield (path.parent / name).resolve() if name else path.resolve(), anchor


def dead_links(paths):
    for path in paths:
        for target, anchor in links_of(path):
            if not target.exists():
                yield f"{path}: there is no {target}"
            elif anchor and anchor not in anchors_of(target.read_text()):
                yield f"{path}: {target.name} has no section #{anchor}"
