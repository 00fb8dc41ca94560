# SPDX-License-Identifier: GPL-3.0-or-later
"""Typesets the notation of multibody/equations.md: a line of it becomes MathML, which browsers draw by themselves.

    m_h psi'' = −~S w_h² + Σ_j a_j G_jl^T        [M B^T; B 0] [dQ; dV]

x_i, x^T, x' and ~x are what they look like, a matrix has ; between its rows, and columns stand three spaces apart.
"""

import re
from html import escape

GREEK = dict(zip(
    "alpha beta gamma delta eps zeta theta lambda mu nu xi pi rho sigma tau phi chi psi omega "
    "Gamma Delta Theta Lambda Xi Phi Psi Omega".split(),
    "αβγδεζθλμνξπρστφχψωΓΔΘΛΞΦΨΩ"))
FUNCTIONS = {"sin", "cos", "exp", "sinc", "min", "max", "tr", "diag", "grad", "sign", "null", "Re", "log"}
RAISED = dict(zip("⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789−"))
TOKEN = re.compile(
    r"\s*(?:(?P<sum>[∫Σ])|(?P<plus>\(\+\))|(?P<number>\d+(?:\.\d+)?(?:e-?\d+)?|[½¼])"
    r"|(?P<name>[A-Za-zα-ωΑ-ΩΔ]+)(?P<index>\d*)|(?P<other>.))")
SUBSCRIPT = re.compile(r"_([A-Za-zα-ω0-9]+(?:\+1)?(?:,[A-Za-zα-ω0-9]+)*)")
SUPERSCRIPT = re.compile(r"\^([−-]?[A-Za-z0-9]+)|([⁰¹²³⁴⁵⁶⁷⁸⁹⁻]+)")
CLOSING = {"(": ")", "[": "]"}


def letters(text):
    """Of an index: each letter by itself, words of Greek letters as one."""
    parts = re.findall(r"[A-Za-zα-ω]+|\d+|.", text)
    out = ""
    for part in parts:
        if part in GREEK or part[0].isalpha():
            out += f"<mi>{GREEK.get(part, part)}</mi>"
        else:
            out += f"<mn>{part}</mn>" if part.isdigit() else f"<mo>{escape(part.replace('-', '−'))}</mo>"
    return f"<mrow>{out}</mrow>"


class Line:
    def __init__(self, text):
        self.text, self.at = text, 0

    def scripts(self, base, index=""):
        """What hangs on a symbol: its number, index, power and primes."""
        below, above = index, ""
        while True:
            found = SUBSCRIPT.match(self.text, self.at)
            if found:
                below += ("," if below else "") + found[1]
            else:
                found = SUPERSCRIPT.match(self.text, self.at)
                if found:
                    above += letters(found[1]) if found[1] else letters("".join(RAISED[c] for c in found[2]))
                else:
                    found = re.compile("'+").match(self.text, self.at)
                    if not found:
                        break
                    above += f"<mo>{'′' if len(found[0]) == 1 else '″'}</mo>"
            self.at = found.end()
        above = f"<mrow>{above}</mrow>" if above else ""
        if below and above:
            return f"<msubsup>{base}{letters(below)}{above}</msubsup>"
        if below:
            return f"<msub>{base}{letters(below)}</msub>"
        return f"<msup>{base}{above}</msup>" if above else base

    def atom(self):
        found = TOKEN.match(self.text, self.at)
        self.at = found.end()
        kind, token = found.lastgroup, found[0].strip()
        if found["sum"]:
            index = SUBSCRIPT.match(self.text, self.at)
            if not index:
                return f"<mo>{token}</mo>"
            self.at = index.end()
            return f"<munder><mo>{token}</mo>{letters(index[1])}</munder>"
        if found["plus"]:
            return "<mo>⊕</mo>"
        if found["number"]:
            return self.scripts(f"<mn>{token}</mn>")
        if found["name"]:
            name = found["name"]
            if name in FUNCTIONS:
                return self.scripts(f"<mi>{name}</mi>") + "<mo>&#x2061;</mo>"
            known = GREEK.get(name)
            small = name[0] == "d" and (GREEK.get(name[1:]) or len(name) == 2 and name[1:])
            if not known and not small and len(name) > 2 and name.isascii() and name != "Maa":
                return f"<mtext>&nbsp;{name}{found['index']}&nbsp;</mtext>"
            if small:
                return "<mi>d</mi>" + self.scripts(f"<mi>{small}</mi>", found["index"])
            return self.scripts(f"<mi>{known or name}</mi>", found["index"])
        if token == "~":
            inner = self.atom()
            tilde = "<mo stretchy='false'>~</mo>"
            for tag in ("msubsup", "msub", "msup"):  # over the letter alone, not over its index
                if inner.startswith(f"<{tag}><mi>"):
                    end = inner.index("</mi>") + len("</mi>")
                    begin = len(tag) + 2
                    return f"{inner[:begin]}<mover>{inner[begin:end]}{tilde}</mover>{inner[end:]}"
            return f"<mover>{inner}{tilde}</mover>"
        if token in CLOSING:
            return self.scripts(self.bracket(token))
        return self.scripts(f"<mo>{escape(token.replace('-', '−'))}</mo>") if kind and token else ""

    def bracket(self, opening):
        closing, depth, end = CLOSING[opening], 0, self.at
        while end < len(self.text) and (depth > 0 or self.text[end] != closing):
            depth += {opening: 1, closing: -1}.get(self.text[end], 0)
            end += 1
        inside, self.at = self.text[self.at:end], min(end + 1, len(self.text))
        if ";" in inside and opening == "[":
            rows = [cells(row) for row in inside.split(";")]
            table = "".join("<mtr>" + "".join(f"<mtd>{row_of(cell)}</mtd>" for cell in row) + "</mtr>" for row in rows)
            return f"<mrow><mo>[</mo><mtable>{table}</mtable><mo>]</mo></mrow>"
        return f"<mrow><mo stretchy='false'>{opening}</mo>{row_of(inside)}<mo stretchy='false'>{closing}</mo></mrow>"

    def all(self):
        out = ""
        while self.at < len(self.text) and self.text[self.at:].strip():
            out += self.atom()
        return out


def cells(row):
    """Of a matrix: apart by commas, or by spaces where nothing is added or multiplied."""
    if "," in row:
        return row.split(",")
    return [row] if re.search(r"[+−=×/(]|·.", row) else row.split()


def row_of(text):
    return f"<mrow>{Line(text.strip()).all()}</mrow>"


def inline(text):
    return f"<math>{row_of(text)}</math>"


def display(lines):
    """Lines of equations below one another, in columns where three spaces separate them."""
    rows = [re.split(r"\s{3,}", re.sub(r"\s+=", " =", line.strip())) for line in lines if line.strip()]
    body = "".join("<mtr>" + "".join(f"<mtd>{row_of(cell)}</mtd>" for cell in row) + "</mtr>" for row in rows)
    return f'<math display="block"><mtable columnalign="left" displaystyle="true">{body}</mtable></math>'
