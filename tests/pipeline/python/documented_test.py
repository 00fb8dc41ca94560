# SPDX-License-Identifier: GPL-3.0-or-later
"""Every public name has a docstring, which tells the unit of what is a number and the shape of what is an
array; and the stub has the names and arguments of the compiled module.

Usage: documented_test.py     (PYTHONPATH has the package)
"""

import ast
import inspect
import pathlib
import re
import sys

import flexneck as fn
from flexneck import _core

# Documentation of numbers states their unit, "1" for a pure number; that of arrays the shape, too.
UNIT = re.compile(r"\b(kg|m|s|Hz|N|J|Pa|rad|1|[Pp]er cent)\b|kg\^|`unit`|in another unit|SI unit|their units|rows of|"
                  r"ratings from 0 to 1|of the shape of|with its unit|multiplied")
SHAPE = re.compile(r"\([\w ]+,[\w ,]*\)|of the shape of|a row for each|\bas columns\b")


def public_names():
    """Full name and object of each."""
    for name in fn.__all__:
        thing = getattr(fn, name)
        if isinstance(thing, str):
            continue
        yield name, thing
        if inspect.isclass(thing) and not issubclass(thing, BaseException):
            for member, value in vars(thing).items():
                if not member.startswith("_"):
                    yield f"{name}.{member}", value


def annotation(full, thing):
    """Type of a value or of what a function returns, as text."""
    owner, _, member = full.partition(".")
    fields = getattr(getattr(fn, owner), "__annotations__", {})
    if member in fields:
        return str(fields[member])
    function = thing.fget if isinstance(thing, property) else getattr(thing, "__func__", thing)
    return str(getattr(function, "__annotations__", {}).get("return", ""))


def problem_of(full, thing):
    text = inspect.getdoc(getattr(thing, "__func__", thing)) or ""
    kind = annotation(full, thing)
    if not text or text.startswith("Alias for field"):
        return "has no docstring"
    if "rray" in kind and not SHAPE.search(text):
        return f"tells no shape: {text!r}"
    if re.search(r"rray|\bfloat\b|complex", kind) and not UNIT.search(text):
        return f"tells no unit: {text!r}"
    return ""


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
    package = pathlib.Path(fn.__file__).parent
    problems, names = list(stub_problems(package / "_core.pyi")), dict(public_names())
    if not (package / "py.typed").is_file():
        problems.append("py.typed: missing, so that no checker of types reads the annotations")
    for full, thing in names.items():
        if problem := problem_of(full, thing):
            problems.append(f"{full}: {problem}")
    print("\n".join(problems))
    print(f"{len(names)} public names, {len(problems)} problems")
    sys.exit(bool(problems) or len(names) < 100)


if __name__ == "__main__":
    main()
