# SPDX-License-Identifier: GPL-3.0-or-later
"""Where numeric code can be changed, how, and how the change is put behind a switch."""

import random
import re

TOKEN = re.compile(r"""
    (?P<skip>\s+|//[^\n]*|/\*.*?\*/|\#(?:[^\n\\]|\\.)*)
  | (?P<text>R"(?P<mark>[^(\s]*)\(.*?\)(?P=mark)"|"(?:[^"\\\n]|\\.)*"|'(?:[^'\\\n]|\\.)*')
  | (?P<number>\.?\d(?:'?[\w.]|[eE][+-])*)
  | (?P<name>[A-Za-z_]\w*)
  | (?P<operator><<=|>>=|<=>|->\*|\.\.\.|::|->|\+\+|--|<<|>>|<=|>=|==|!=|&&|\|\||[-+*/%&|^]=|.)
""", re.VERBOSE | re.DOTALL)

SWAPS = {"+": ["-"], "-": ["+"], "*": ["/"], "/": ["*"], "+=": ["-="], "-=": ["+="], "*=": ["/="],
         "/=": ["*="], "<": ["<=", ">"], "<=": ["<", ">"], ">": [">=", "<"], ">=": [">", "<"],
         "==": ["!="], "!=": ["=="]}
OPEN, CLOSE = {"(": ")", "[": "]", "{": "}"}, {")": "(", "]": "[", "}": "{"}
CONTROL = {"if", "while", "for", "switch"}
WORDS = {"return", "case", "else", "do", "co_return", "throw"}  # names that end no operand
DECLARES = {"template", "using", "namespace", "class", "struct", "enum", "friend", "typedef", "static_assert",
            "operator", "constexpr", "include"}
DECLARATION = re.compile(r"(?P<type>(?:const\s+|static\s+)*(?:[A-Za-z_][\w:]*(?:<[^;=()]*>)?(?:::\w+)*)\s*[&*]?)"
                         r"\s(?P<name>&?\w+)\s*=(?P<value>[^=].*);$", re.DOTALL)


class Token:
    def __init__(self, match):
        self.kind, self.text, self.begin, self.end = match.lastgroup, match.group(), *match.span()
        if self.kind == "mark":
            self.kind = "text"


def tokens_of(source):
    return [token for token in map(Token, TOKEN.finditer(source)) if token.kind != "skip"]


class File:
    def __init__(self, path, source):
        self.path, self.source = path, source
        self.tokens = tokens_of(source)
        self.partner = self.match_brackets()

    def match_brackets(self):
        partner, stack = {}, []
        for k, token in enumerate(self.tokens):
            if token.text in OPEN and token.kind == "operator":
                stack.append(k)
            elif token.text in CLOSE and token.kind == "operator" and stack:
                partner[k] = stack.pop()
                partner[partner[k]] = k
        return partner

    def text(self, first, last):
        """Of the tokens from first to last."""
        return self.source[self.tokens[first].begin:self.tokens[last].end]

    def ends_operand(self, k):
        token = self.tokens[k]
        return (token.kind in ("number", "text") or token.text in (")", "]", "}") or
                token.kind == "name" and token.text not in WORDS)

    def changes(self):
        """(token, what stands in its place), of operators with a blank on both sides, which templates' brackets,
        references and pointers have not, of signs, and of indices."""
        for k in range(1, len(self.tokens) - 1):
            token = self.tokens[k]
            spaced = self.source[token.begin - 1] == " " and self.source[token.end] in " \n"
            if token.text in SWAPS and token.kind == "operator" and spaced and self.ends_operand(k - 1):
                yield from ((k, other) for other in SWAPS[token.text])
            elif token.text == "-" and not self.ends_operand(k - 1):
                yield k, ""
            elif self.is_index(k):
                yield k, str(int(token.text) + 1 if token.text == "0" else int(token.text) - 1)

    def is_index(self, k):
        before, after = self.tokens[k - 1].text, self.tokens[k + 1].text
        return (self.tokens[k].text in ("0", "1", "2", "3") and before in ("[", "(", ",") and
                after in ("]", ")", ",") and (before == "[" or self.opens_call(k)))

    def opens_call(self, k):
        """Whether it stands in the brackets behind the name of something that is indexed or selected."""
        outer = self.enclosing(k)
        return (outer is not None and self.tokens[outer].text == "(" and outer > 0 and
                self.tokens[outer - 1].kind == "name" and self.tokens[outer - 1].text not in CONTROL)

    def enclosing(self, k):
        for j in range(k - 1, -1, -1):
            if j in self.partner and self.partner[j] > k > j:
                return j
        return None

    def is_block(self, k):
        """Whether an opening brace begins statements, not values."""
        return self.tokens[k].text == "{" and (
            k == 0 or self.tokens[k - 1].text in (")", ";", "{", "}", "else", "do", "try", "const", "noexcept",
                                                  "override", ":", "mutable"))

    def statement(self, k):
        """First and last token of the statement around token k; none where that is not to be told."""
        first = k
        while True:
            outer = self.enclosing(first)
            if outer is None:
                return None
            if self.is_block(outer):
                break
            first = outer
        j = first - 1
        while j > outer:
            text = self.tokens[j].text
            if text == ";" or text == "}" and self.ends_block(j):
                break
            j = self.partner.get(j, j) if text in CLOSE else j
            j -= 1
        begin = last = j + 1
        while self.tokens[last].text != ";":
            last = self.partner.get(last, last) if self.tokens[last].text in OPEN else last
            last += 1
            if last >= self.partner[outer]:
                return None
        return begin, last

    def ends_block(self, j):
        return self.is_block(self.partner[j]) or self.tokens[j + 1].kind == "name"

    def group(self, k):
        """First and last token of what stands around token k between commas, semicolons or brackets."""
        outer = self.enclosing(k)
        if outer is None:
            return None
        first = last = k
        while self.tokens[first - 1].text not in (",", ";") and first - 1 != outer:
            first = self.partner.get(first - 1, first - 1) if self.tokens[first - 1].text in CLOSE else first - 1
        while self.tokens[last + 1].text not in (",", ";") and last + 1 != self.partner[outer]:
            last = self.partner.get(last + 1, last + 1) if self.tokens[last + 1].text in OPEN else last + 1
        return first, last

    def changed(self, first, last, k, text):
        """The tokens from first to last with `text` in place of token k."""
        token = self.tokens[k]
        return self.source[self.tokens[first].begin:token.begin] + text + self.source[token.end:self.tokens[last].end]

    def forms(self, k, text, switch):
        """Ways to write the change behind the switch: (begin, end, replacement) in the source, best first."""
        statement = self.statement(k)
        if statement and not DECLARES & {token.text for token in self.tokens[statement[0]:k]}:
            whole, other = self.text(*statement), self.changed(*statement, k, text)
            span = self.tokens[statement[0]].begin, self.tokens[statement[1]].end
            before, after = DECLARATION.match(whole), DECLARATION.match(other)
            if before and after and before["type"].strip() not in WORDS:
                kind = re.sub(r"\b(const|static)\b|[&*]", "", before["type"]).strip()
                yield (*span, f"{whole[:before.start('value')]} {switch} ? {kind}({after['value']}) : "
                              f"{kind}({before['value']});")
                yield (*span, f"{whole[:before.start('value')]} {switch} ? ({after['value']}) : ({before['value']});")
            elif self.tokens[statement[0]].text not in ("for", "while", "switch", "case", "else", "do"):
                yield (*span, f"if ({switch}) {{ {other} }} else {{ {whole} }}")
        group = self.group(k)
        if group:
            yield (self.tokens[group[0]].begin, self.tokens[group[1]].end,
                   f"({switch} ? ({self.changed(*group, k, text)}) : ({self.text(*group)}))")


def draw(files, seed):
    """All changes of all files in an order that the seed decides."""
    every = [(file, k, text) for file in files for k, text in file.changes()]
    random.Random(str(seed)).shuffle(every)
    return every
