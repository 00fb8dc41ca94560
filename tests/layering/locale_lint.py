#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers and letters are read and written whatever the locale is, which belongs to the program
around the library: no room calls a function of C that depends on it.

Usage: locale_lint.py NM BUILD
"""

import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
ROOMS = ("geometry", "mesher", "fe_modal", "multibody", "pipeline")
INSTEAD = {
    r"(?:ato[fdl]|sto(?:d|f|ld)|strto(?:d|f|ld)|v?[fs]+scanf)": "std::from_chars",
    r"(?:v?s?n?printf|ostringstream|stringstream|to_wstring|setprecision)":
        "rounded_text(), fixed_text() or exact_text() of output_file.h",
    r"(?:to(?:upper|lower)|is(?:alpha|digit|alnum|space|upper|lower|punct|xdigit|blank|print))":
        "ascii.h",
    r"setlocale": "the locale is the program's around the library",
}
# These files write hexadecimal digits only, or use a stream with the locale of C.
EXCEPT = {"geometry/foundation/content_hash.cpp", "geometry/foundation/printable.cpp",
          "pipeline/language/document/toml_source.cpp"}


def in_sources():
    for room in ROOMS:
        for source in sorted((ROOT / room).rglob("*")):
            path = str(source.relative_to(ROOT))
            if source.suffix not in (".h", ".cpp") or path in EXCEPT:
                continue
            for number, line in enumerate(source.read_text().splitlines(), 1):
                code = re.sub(r'"(?:[^"\\]|\\.)*"', '""', line.split("//")[0])
                for pattern, instead in INSTEAD.items():
                    found = re.search(r"(?<![\w.>])" + pattern + r"(?=\s*[({<\s])", code)
                    if found:
                        yield f"{path}:{number}: {found[0]} depends on the locale; use {instead}"


def in_objects(nm, build):
    """std::to_string() of a floating number, which a source does not tell from that of an integer."""
    for library in sorted(build.glob("*/**/libflexneck_*.a")):
        if "tests" in library.relative_to(build).parts:
            continue
        symbols = subprocess.run([nm, "-A", "-C", library], check=True, capture_output=True,
                                 text=True).stdout
        names = {}
        for line in symbols.splitlines():
            names.setdefault(line.split(":")[1], []).append(line)
        for name, lines in names.items():
            text = "\n".join(lines)
            if "__gnu_cxx::__to_xstring<" in text and "CLI::" not in text:  # CLI11 has its own
                yield (f"{name}: std::to_string() of a floating number depends on the locale; use "
                       "rounded_text() of output_file.h")


def main():
    problems = [*in_sources(), *in_objects(sys.argv[1], pathlib.Path(sys.argv[2]))]
    print("\n".join(problems))
    sys.exit(bool(problems))


if __name__ == "__main__":
    main()
