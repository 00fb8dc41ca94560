#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The manual has every key that the sources' tables of keys have, and its typeset equations lose nothing.

Usage: manual_test.py FLEXNECK SOURCES
"""

import re
import sys
import unittest
import xml.etree.ElementTree
from pathlib import Path

FLEXNECK, SOURCES = (Path(word).resolve() for word in sys.argv[1:3])
sys.path.insert(0, str(SOURCES / "pipeline/manual"))
import conf  # noqa: E402
import make_manual  # noqa: E402
import mathml  # noqa: E402


def signs(text):
    """Letters and digits, words of Greek letters as one letter."""
    for name in sorted(mathml.GREEK, key=len, reverse=True):
        text = re.sub(rf"(?<![A-Za-z])(d?){name}(?![a-z])", rf"\1{mathml.GREEK[name]}", text)
    return "".join(mathml.RAISED.get(sign, sign) for sign in text if sign.isalnum() or sign in mathml.RAISED)


def drawn(markup):
    tree = xml.etree.ElementTree.fromstring(markup.replace("&nbsp;", " "))
    return "".join(sign for sign in "".join(tree.itertext()) if sign.isalnum())


class Manual(unittest.TestCase):
    def test_contents_link_chapters_and_sections_of_their_own(self):
        def chapter(name, *sections):
            return f'<span id="document-{name}"></span><section id="{name}">\n<h2>{name}</h2>\n' + "".join(
                f'<section id="{each}">\n<span id="text"></span><h3>{each}</h3></section>\n' for each in sections) + "</section>"

        links = re.findall('href="#([^"]+)"', conf.contents_of(
            '<h1>all</h1>' + chapter("tour", "first", "more") + chapter("files", "more", "last")))
        self.assertEqual(links, ["tour", "first", "files", "last"])

    def test_every_key_is_documented(self):
        """Against the sources, whose tables have rows such as Key::text("name", …)."""
        keys = set()
        for path in SOURCES.glob("pipeline/**/*.cpp"):
            keys |= set(re.findall(r'\bKey::\w+\(\s*"(\w+)"', path.read_text()))
        chapter = make_manual.keys_chapter(FLEXNECK)
        documented = re.findall(r"^ +(\w+) \((?=[^)]*\))", chapter, re.MULTILINE)
        tables = re.findall(r"\[([\w.]+)\]", chapter)
        names = set(documented) | {part for table in tables for part in table.split(".")}
        print(f"{len(documented)} keys in {len(set(tables))} tables, {len(keys)} different names")
        self.assertGreater(len(keys), 200)
        self.assertEqual(keys - names, set())

    def test_equations_lose_no_sign(self):
        lines = [line for line in (SOURCES / make_manual.EQUATIONS).read_text().splitlines()
                 if line.startswith("    ")]
        self.assertGreater(len(lines), 40)
        for line in lines:
            self.assertEqual(drawn(mathml.display([line])), signs(line), line)

    def test_an_equation_is_set_as_it_is_read(self):
        self.assertEqual(mathml.inline("J_l^T omega''"),
                         "<math><mrow><msubsup><mi>J</mi><mrow><mi>l</mi></mrow><mrow><mrow><mi>T</mi></mrow></mrow>"
                         "</msubsup><msup><mi>ω</mi><mrow><mo>″</mo></mrow></msup></mrow></math>")
        rows = xml.etree.ElementTree.fromstring(mathml.inline("[M B^T; B 0]")).findall(".//mtr")
        self.assertEqual([len(row.findall("mtd")) for row in rows], [2, 2])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
