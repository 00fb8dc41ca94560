# SPDX-License-Identifier: GPL-3.0-or-later
"""Every public name has a docstring, every one with a value says of what shape or unit it is, and
the stub has the names of the compiled module.

Usage: documented_test.py BUILD SOURCES
"""

import ast
import inspect
import pathlib
import re
import sys
import typing

import flexneck as fn
from flexneck import _core

# What tells a shape, a unit, or that there is none.
TOLD = re.compile(r"\(\w*,|\b(m|mm|kg|s|Hz|N|J|Pa|rad|deg|K)\b|per cent|unit|array|samples|index|text|names?\b|"
                  r"Such as|such as|folder|files?\b|by name|by their|[Ww]hether|[Ww]hat|[Ww]hy|[Hh]ow many|"
                  r"study|model|\bas columns|dictionary|processors|case|floats|empty|published")


def public_names():
    """Full name, object and docstring of each."""
    for name in fn.__all__:
        thing = getattr(fn, name)
        if isinstance(thing, str):
            continue
        yield name, thing
        if inspect.isclass(thing) and not issubclass(thing, BaseException):
            for member, value in vars(thing).items():
                if not member.startswith("_") or member == "__getitem__" and not issubclass(thing, typing.Mapping):
                    yield f"{name}.{member}", value


def documentation(full, thing, sources):
    if full.count(".") == 1 and (inspect.isdatadescriptor(thing) and not isinstance(thing, property)
                                 or isinstance(thing, str)):
        return sources.get(full, "")
    return inspect.getdoc(thing.__func__ if isinstance(thing, staticmethod) else thing) or ""


def field_documentation(package):
    """The text below each annotated field of a class, and the fields."""
    found = {}
    for path in package.glob("*.py"):
        for node in ast.parse(path.read_text()).body:
            if isinstance(node, ast.ClassDef):
                for field, after in zip(node.body, node.body[1:] + [None]):
                    if isinstance(field, ast.AnnAssign):
                        told = isinstance(after, ast.Expr) and isinstance(after.value, ast.Constant)
                        found[f"{node.name}.{field.target.id}"] = after.value.value if told else ""
    return found


def stub_problems(stub):
    names = {}
    for node in ast.parse(stub.read_text()).body:
        if isinstance(node, ast.ClassDef):
            names[node.name] = {each.name for each in node.body if isinstance(each, ast.FunctionDef)}
        elif isinstance(node, ast.FunctionDef):
            arguments = [each.arg for each in node.args.args]
            signature = getattr(_core, node.name, None).__doc__.splitlines()[0]
            told = re.findall(r"(\w+): ", signature[signature.index("(") + 1:signature.rindex("->")])
            if arguments != told:
                yield f"_core.pyi: {node.name}({', '.join(arguments)}), the module has {told}"
            names[node.name] = None
    there = {name for name in dir(_core) if not name.startswith("__") and name != "git_hash"}
    if there != set(names):
        yield f"_core.pyi: differs from the module in {there ^ set(names)}"
    for name, members in names.items():
        if members is not None:
            has = {each for each in vars(getattr(_core, name)) if not each.startswith("_")}
            if has != members - {"__init__"}:
                yield f"_core.pyi: {name} differs in {has ^ (members - {'__init__'})}"


def main():
    package = pathlib.Path(sys.argv[2]) / "pipeline/python/flexneck"
    fields = field_documentation(package)
    problems, count = list(stub_problems(package / "_core.pyi")), 0
    for full, thing in public_names():
        count += 1
        text = documentation(full, thing, fields)
        if not text:
            problems.append(f"{full}: has no docstring")
        elif "." in full and not TOLD.search(text):
            problems.append(f"{full}: tells neither shape nor unit nor kind: {text!r}")
    print("\n".join(problems))
    print(f"{count} public names, {len(problems)} problems")
    sys.exit(bool(problems) or count < 100)


if __name__ == "__main__":
    main()
