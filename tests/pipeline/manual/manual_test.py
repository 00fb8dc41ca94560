#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The manual has every key that the sources' tables of keys have; links of all texts lead somewhere, where they are installed,
too; pages say for whom they are.

Usage: manual_test.py FLEXNECK SOURCES
"""

import re
import sys
import unittest
from pathlib import Path

import links

FLEXNECK, SOURCES = (Path(word).resolve() for word in sys.argv[1:3])
MANUAL = SOURCES / "pipeline/manual"
sys.path.insert(0, str(MANUAL))
import make_manual  # noqa: E402

PAGES = [path for path in sorted(MANUAL.rglob("*.md")) if path.name != "README.md"]
TEXTS = [path for path in sorted(SOURCES.rglob("*.md"))
         if not any(part.startswith(("build", "out", ".")) for part in path.relative_to(SOURCES).parts)]
# Notes of what happened, a line for each event.
LOGS = {"CHANGES.md", "campaigns.md"}


def first_paragraph(text):
    return re.match(r"# [^\n]*\n\n(.*?)\n(?:\n|$)", text, re.DOTALL)[1]


class Manual(unittest.TestCase):
    def test_every_key_is_documented(self):
        """Against the sources, whose tables have rows such as Key::text("name", …)."""
        keys = set()
        for path in SOURCES.glob("pipeline/**/*.cpp"):
            keys |= set(re.findall(r'\bKey::\w+\(\s*"(\w+)"', path.read_text()))
        page = make_manual.keys_page(FLEXNECK)
        documented = re.findall(r"^ +(\w+) \((?=[^)]*\))", page, re.MULTILINE)
        tables = re.findall(r"\[([\w.]+)\]", page)
        names = set(documented) | {part for table in tables for part in table.split(".")}
        print(f"{len(documented)} keys in {len(set(tables))} tables, {len(keys)} different names")
        self.assertGreater(len(keys), 200)
        self.assertEqual(keys - names, set())

    def test_every_command_is_documented(self):
        page = make_manual.commands_page(FLEXNECK)
        self.assertGreater(len(re.findall(r"^## flexneck \w+$", page, re.MULTILINE)), 15)

    def test_links_lead_somewhere(self):
        count = sum(len(list(links.links_of(path))) for path in TEXTS)
        print(f"{count} links of {len(TEXTS)} texts")
        self.assertGreater(count, 100)
        self.assertEqual(list(links.dead_links(TEXTS)), [])

    def test_texts_that_are_installed_link_to_one_another_alone(self):
        """cmake/Install.cmake installs these in the layout of the sources; tests/install/ looks at the outcome."""
        for path in [SOURCES / "README.md", *PAGES]:
            for target, _ in links.links_of(path):
                place = target.relative_to(SOURCES).as_posix()
                self.assertRegex(place, r"^(README\.md|LICENSE|pipeline/(manual|data/pictures)/.*\.(md|cff|png))$", path)
                self.assertNotEqual(place, "pipeline/manual/README.md", path)

    def test_pages_say_for_whom_they_are(self):
        generated = [make_manual.commands_page(FLEXNECK), make_manual.keys_page(FLEXNECK),
                     make_manual.python_page(SOURCES / "pipeline/python/flexneck")]
        for text in [path.read_text() for path in [SOURCES / "README.md", *PAGES]] + generated:
            self.assertRegex(first_paragraph(text), r"^For ")

    def test_the_contents_name_every_page(self):
        named = re.findall(r"^([a-z_]+(?:/[a-z_]+)?)$", make_manual.contents((MANUAL / "index.md").read_text()), re.MULTILINE)
        written = {"reference/commands", "reference/keys", "reference/python", "reference/cpp", "theory/validation"}
        pages = {path.relative_to(MANUAL).with_suffix("").as_posix() for path in PAGES} - {"index"}
        self.assertEqual(sorted(named), sorted(pages | written))

    def test_readmes_are_short(self):
        for path in TEXTS:
            if MANUAL not in path.parents and path.name not in LOGS:
                self.assertLessEqual(len(path.read_text().split()), 1000, path)

    def test_formulas_begin_and_end(self):
        formulas = 0
        for path in PAGES:
            text = links.prose_of(path.read_text())
            displayed = re.findall(r"^\$\$\n(.*?)\n\$\$$", text, re.MULTILINE | re.DOTALL)
            rest = re.sub(r"^\$\$\n.*?\n\$\$$", "", text, flags=re.MULTILINE | re.DOTALL)
            self.assertNotIn("$$", rest, path)
            inline = [match for part in rest.split("\n\n") for match in re.findall(r"\$([^$]+)\$", part)]
            self.assertEqual(rest.count("$"), 2 * len(inline), path)
            for formula in displayed + inline:
                self.assertEqual(formula.count("{"), formula.count("}"), (path, formula))
                begun, ended = (sorted(re.findall(rf"\\{word}\{{(\w+)", formula)) for word in ("begin", "end"))
                self.assertEqual(begun, ended, (path, formula))
            formulas += len(displayed) + len(inline)
        print(f"{formulas} formulas")
        self.assertGreater(formulas, 400)

    def test_packages_that_are_missing_are_named_as_they_are_installed(self):
        listed = (SOURCES / "cmake/packages.txt").read_text().partition("[manual]")[2].split()
        there, make_manual.MATHJAX = make_manual.MATHJAX, Path("/nowhere")
        try:
            missing = make_manual.missing()
        finally:
            make_manual.MATHJAX = there
        self.assertIn("libjs-mathjax", missing)
        self.assertEqual(set(missing) - set(listed), set())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
