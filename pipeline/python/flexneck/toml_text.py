# SPDX-License-Identifier: GPL-3.0-or-later
"""Conversion of Python values to TOML, for models that are built in code."""

from __future__ import annotations

import json
import re
import typing

from .errors import InputError


def value_text(value: typing.Any, key: str) -> str:
    """A value as TOML text; also for arrays and numbers of NumPy."""
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(value_text(each, key) for each in value) + "]"
    if isinstance(value, dict):
        pairs = (f"{_name(name)} = {value_text(each, key)}" for name, each in value.items())
        return "{ " + ", ".join(pairs) + " }"
    raise InputError(f"{key}: expected a text, a number, True or False, a list or a dictionary, "
                     f"found {type(value).__name__}")


def document_text(tables: dict[str, typing.Any]) -> str:
    """A TOML document: first values, then tables, then arrays of tables."""
    lines = [f"{_name(name)} = {value_text(value, name)}" for name, value in tables.items()
             if not _is_section(value)]
    for name, value in tables.items():
        if _is_section(value):
            heading = "[{}]" if isinstance(value, dict) else "[[{}]]"
            for each in [value] if isinstance(value, dict) else value:
                lines += ["", heading.format(_name(name))]
                lines += [f"{_name(key)} = {value_text(part, f'{name}.{key}')}"
                          for key, part in each.items()]
    return "\n".join(lines) + "\n"


def setting(key: str, value: typing.Any) -> str:
    """`key=value` as the command line's --set takes it; a text stays as it is."""
    return f"{key}={value if isinstance(value, str) else value_text(value, key)}"


def _name(key: str) -> str:
    if not isinstance(key, str):
        raise InputError(f"expected the name of a key or table, found {key!r}")
    return key if re.fullmatch(r"[A-Za-z0-9_-]+", key) else json.dumps(key, ensure_ascii=False)


def _is_section(value: typing.Any) -> bool:
    return isinstance(value, dict) or (isinstance(value, (list, tuple)) and len(value) > 0
                                       and all(isinstance(each, dict) for each in value))
