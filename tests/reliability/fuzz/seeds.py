# SPDX-License-Identifier: GPL-3.0-or-later
"""What the targets start from: a few sound inputs of each, and the words that their readers know,
taken from the sources of the readers and from the files that ship."""

import json
import os
import random
import re
import struct

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../..")
# Sources that contain the words of a target's dictionary.
WORDS = {
    "deck": ["mesher/exchange/inp_", "mesher/exchange/abaqus"],
    "survey": ["mesher/exchange/nastran", "mesher/exchange/unv", "mesher/exchange/left_out"],
    "signature": ["mesher/exchange/file_signature"],
    "study": ["pipeline/language/study/", "pipeline/language/document/", "pipeline/language/model/resistance", "fe_modal/body/basis_kind"],
    "settings": ["pipeline/language/study/", "pipeline/language/document/"],
    "model": ["pipeline/language/model/", "pipeline/language/document/"],
    "reference": ["pipeline/experiments/verification/reference", "pipeline/language/document/study_node"],
    "regulation": ["pipeline/language/study/regulation", "pipeline/language/document/study_node"],
    "results": ["pipeline/process/result_table", "pipeline/experiments/verification/", "pipeline/process/prov"],
    "matrix": ["fe_modal/exchange/matrix_market"],
    "mme": ["pipeline/laboratory/iso_mme/"],
    "body": ["fe_modal/exchange/mbdyn_fem", "fe_modal/exchange/sid_fem"],
}
TOML = ['"""', "'''", "[[", "]]", "[", "]", "{ value = ", ", origin = \"published\"", " }", " = ",
        "include = [\"hybrid3_c.toml\"]", "include = [\"study.toml\"]", "inf", "nan", "1979-05-27",
        "true", "0x10", "1e400", "\\u0000", "\\n", ".", "#", "\n"]
UNITS = ["m", "mm", "in", "kg", "lb", "lbf", "s", "ms", "deg", "rad", "Hz", "Pa", "kpsi", "gn", "%",
         "kg/m^3", "kg*m^2", "N/m", "N*s/m", "lbf*s^2*in", "1/s", "K", "degC", "lg(re mW)", "@"]
FUNCTIONS = ["sin(", "sqrt(", "min(", "max(", "sum(", "rint(", "pi", "gn", "t", "_e", "&&", "||",
             "==", "!=", "<=", "?", ":", "^", "e-3", "1e308", ")"]
EXTRA = {"study": TOML + UNITS, "model": TOML + UNITS + FUNCTIONS, "settings": TOML,
         "reference": TOML + UNITS, "regulation": TOML + UNITS, "quantity": UNITS, "expression": FUNCTIONS,
         "curve": UNITS + [",", "\r\n", "time [ms]", "\"head rotation [deg]\"", "# ", "nan", "1e999"],
         "mme": UNITS + [":", "\n", "\r\n", "NOVALUE", "Nm", "====\n", "\xb0", "\x93", "11HEAD0000H3ANYC", "nan", "1e999"],
         "table": UNITS + [",", "\r\n", "time [ms]", "# ", "\xef\xbb\xbf", "nan", "1e999"],
         "results": ["{", "}", "[", "]", ":", ",", "null", "true", "\\u0000", "\\ud800", "1e999"],
         "deck": ["*INCLUDE, INPUT=deck.inp\n", "GENERATE", "C3D10", "C3D15", "C3D8", "C3D20R", "\n*", ",\n"],
         "signature": ["$EndMeshFormat", "$MeshFormat\n4.1 0 8\n", "$Nodes", "$EndNodes"]}

DECK = """*HEADING
*NODE, NSET=all
1, 0, 0, 0
2, 1, 0, 0
3, 1, 1, 0
4, 0, 1, 0
5, 0, 0, 1
6, 1, 0, 1
7, 1, 1, 1
8, 0, 1, 1
9, 0, 0, 2.D0
10, 1, 0, 2
11, 1, 1, 2
12, 0, 1, 2
*ELEMENT, TYPE=C3D8I, ELSET=low
1, 1, 2, 3, 4,
5, 6, 7, 8
*ELEMENT, TYPE=C3D8, ELSET=high
2, 5, 6, 7, 8, 9, 10, 11, 12
*NSET, NSET=held, GENERATE
1, 4, 1
*ELSET, ELSET=both
low, 2
*MATERIAL, NAME="a b"
*DENSITY
1
*ELASTIC, TYPE=ISOTROPIC
1, .3
*SOLID SECTION, ELSET=low, MATERIAL="A B"
*SOLID SECTION, ELSET=high,
 MATERIAL="a b"
*SURFACE, NAME=under
low, S1
2, S2
*BOUNDARY
held, 1, 3
*STEP
*FREQUENCY
10
*DLOAD
*END STEP
"""
TETRAHEDRON = """*NODE
1, 0, 0, 0
2, 2, 0, 0
3, 0, 2, 0
4, 0, 0, 2
5, 1, 0, 0
6, 1, 1, 0
7, 0, 1, 0
8, 0, 0, 1
9, 1, 0, 1
10, 0, 1, 1
*ELEMENT, TYPE=C3D10, ELSET=bar
1, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10
*MATERIAL, NAME=steel
*ELASTIC
210000., 0.3
*DENSITY
7.8E-9,
*SOLID SECTION, ELSET=bar, MATERIAL=steel
"""
NASTRAN = """SOL 103
BEGIN BULK
GRID    1               0.0     0.0     0.0
GRID*   2                               10.0            0.0
*       0.0
GRID,3,,0.,10.,0.
GRID,4,,0.,0.,10.,,123
CTETRA  1       1       1       2       3       4
CONM2,7,1,,2.5
PSOLID,1,1
MAT1,1,7.+10,,.3,2700.
PARAM,WTMASS,.00259
SPC1,1,123,1,THRU,3
ENDDATA
"""
UNIVERSAL = """    -1
   164
         1  SI: Meter                    2
    1.0000000000000000D+03    1.0000000000000000D+00
    -1
    -1
  2411
         1         1         1        11
   0.0000000000000000D+00   0.0000000000000000D+00   1.0000000000000000D+00
    -1
    -1
  2412
         1       111         1         1         7         4
         1         2         3         4
         2        21         1         1         7         2
         0         1         1
         1         2
    -1
    -1
   755
    -1
"""
TABLES = {"format": "flexneck tables", "format_version": 1,
          "provenance": {"program": "flexneck 0.1.0", "git_hash": "0", "inputs": {"a.h5": "00"}},
          "tables": [{"name": "peaks", "title": "Peaks", "columns": [{"name": "x", "unit": "deg"}],
                      "rows": [["1.0"], ["-"]], "notes": ["synthetic"]}]}
ROW = {"quantity": "bending 1", "detail": "of", "unit": "Hz", "value": "1", "reference": "1",
       "error_percent": -0.5, "status": "passed", "fitted": True}
VERIFICATION = {"format": "flexneck verification", "schema_version": 1, "passed": True,
                "reference_origins": "published", "rows": [ROW, {**ROW, "error_percent": None}],
                "provenance": TABLES["provenance"]}
MME_INDEX = """Instrumentation standard    :SAEJ211
Number of channels          :1
Name of channel 001         :11NECKUP00H3MOYP / Neck Upper Moment Y
"""
MME_CHANNEL = """Channel code                :11NECKUP00H3MOYP
Reference channel           :implicit
Name of the channel         :Neck Upper Moment Y
Sampling interval           :0.0001
Unit                        :Nm
Time of first sample        :-0.0002
Number of samples           :3
-6.774550E-4
+1
8.210000E-3
"""
SETTINGS = ["modes.count=4", "body.head.mass=2 kg\nbody.base.mass={ value = \"1 kg\" }",
            "solver.gravity=[\"0 gn\", \"0 gn\", \"9.81 m/s^2\"]", "a.b.c.d=1\na.b=2", "modes=1",
            "modes.fixed=[\"x\"]\nmodes.count=\"\"\"x\"\"\"", "body.head={ name = \"x\" }"]
EXPRESSIONS = ["0.05 * sin(2 * pi * 3 * t)", "t < 1 ? gn * t^2 : max(1, t, 3)", "(t > 0) && (t < 1)",
               "1e-3 * exp(-t / 0.01)", "-t^-2", "rint(t) % 2"]
# Two masses along x, the second of which moves along y in the only mode.
MBDYN = """** RECORD GROUP 1, HEADER
 REV0 2 1 0 0 0
** RECORD GROUP 2
 1 2
** INTERFACE 2 tip
** RECORD GROUP 5
 0. 1.
** RECORD GROUP 6
 0. 0.
** RECORD GROUP 7
 0. 0.
** RECORD GROUP 8
** NORMAL MODE SHAPE # 1: bending, normal
 0. 0. 0. 0. 0. 0.
 0. 1. 0. 0. 0. 1D0
** RECORD GROUP 9
 1.
** RECORD GROUP 10
 2.
** RECORD GROUP 11
 1. 1. 1. 0. 0. 0.
 1. 1. 1. 0. 0. 0.
** END OF FILE
"""


def sid_block(name, order, rows, columns, structure, entries=()):
    keys = dict(order=order, nrow=rows, ncol=columns, nq=1, nqn=0, structure=structure)
    return [name, *(f"{key} = {value}" for key, value in keys.items()), *entries, f"end {name}"]


def sid_body():
    """The same as SID_FEM."""
    node = [*sid_block("origin", 1, 3, 1, 3, ["m0( 1, 1) = 1.D+00", "m1( 2, 1, 1) = 1."]),
            *sid_block("phi", 0, 3, 1, 3, ["m0( 2, 1) = 1."]), *sid_block("psi", 0, 3, 1, 0),
            *sid_block("AP", 1, 3, 3, 4)]
    return "\n".join([
        "1 1 :text; 2 = tip", "part", "new modal =", "refmod", "mass = 2.", "nelastq = 1",
        "ielastq ( 1) = Eigen Mode 1 : 0.2 Hz", "end refmod", "frame", "new node = 2", "rframe = body ref", *node,
        "end node", "end frame", *sid_block("mdCM", 1, 3, 1, 3, ["m0( 1, 1) = 1.", "m1( 2, 1, 1) = 1."]),
        *sid_block("J", 1, 6, 1, 3, ["m0( 2, 1) = 1.", "m0( 3, 1) = 1.", "m1( 4, 1, 1) = -1."]),
        *sid_block("Ct", 0, 1, 3, 3, ["m0( 1, 2) = 1."]), *sid_block("Cr", 1, 1, 3, 3, ["m0( 1, 3) = 1."]),
        *sid_block("Me", 0, 1, 1, 4), *sid_block("Gr", 0, 3, 3, 3, ["m0( 2, 1) = -2."]), *sid_block("Ge", 0, 1, 3, 0),
        *sid_block("Oe", 1, 1, 6, 3, ["m0( 1, 4) = 1.", "m1( 1, 1, 1) = -1.", "m1( 1, 1, 3) = -1."]),
        *sid_block("ksigma", 0, 1, 1, 0), *sid_block("Ke", 0, 1, 1, 1, ["m0( 1, 1) = 2."]),
        *sid_block("De", 0, 1, 1, 0), "end modal", "end part", ""])


MATRIX_MARKET = "%%MatrixMarket matrix coordinate real symmetric\n% two\n2 2 3\n1 1 4.\n2 1 -1\n2 2 3\n"
ARRAY = "%%MatrixMarket matrix array real general\n2 3\n1\n2\n3\n4\n5\n6\n"


def _text_of(*path):
    with open(os.path.join(ROOT, *path), encoding="utf-8") as file:
        return file.read()


def _files(folder, ending):
    return [_text_of(folder, name) for name in sorted(os.listdir(os.path.join(ROOT, folder)))
            if name.endswith(ending)]


def _beside(text):
    """With the names of files that the target has beside its input."""
    text = re.sub(r'"[^"]*\.csv"', '"pulse.csv"', text)
    text = re.sub(r'"[^"]*modes\.h5"', '"modes.h5"', text)
    text = re.sub(r'file = "[^"]*\.toml"', 'file = "part.toml"', text)
    return re.sub(r'include = \[[^]]*\]', "", text)


def _tables_of(text):
    """The text up to each of its tables, so that small inputs are among the seeds; but not what
    takes long to read."""
    if "modes.h5" in text:
        return [text]
    places = [match.start() for match in re.finditer(r"^\[", text, re.MULTILINE)]
    return [text[:place] for place in places[1::3]] + [text]


def _quantities(texts):
    found = sorted({match for text in texts for match in re.findall(r'"([-+.\de]+ [^"]+)"', text)})
    return [bytes([k]) + value.encode() for k in range(8) for value in found[k::8]]


def _scripts():
    """Edits of HDF5 files, several of each kind."""
    generator = random.Random(1)
    return [b""] + [bytes([kind, 0]) + generator.randbytes(length)
                    for kind in range(17) for length in (4, 8, 12, 24)]


def inputs():
    """Sound inputs, as bytes, by target."""
    import sound_files  # beside the folder of this file
    studies = _files("pipeline/data/studies", ".toml") + _files("geometry/examples", ".toml")
    models = _files("pipeline/data/models", ".toml") + [sound_files.MODEL.replace("bar.end", "bar.tip")]
    study = sound_files.STUDY.format(file="bar.msh", unit="", part="bar", held="clamp", tip="tip")
    petsc = struct.pack(">4i2i3i3d", 1211216, 2, 2, 3, 2, 1, 0, 1, 1, 4, -1, 3)
    texts = {
        "curve": ["#b\ntime [ms],a [deg],\"b [g]\"\n0,1,2\n1,3,4\n", "0,1\n0.1,2\n"],
        "deck": [DECK, TETRAHEDRON],
        "expression": EXPRESSIONS,
        "model": [part for text in models for part in _tables_of(_beside(text))],
        "mme": [MME_CHANNEL, MME_INDEX + "====\n" + MME_CHANNEL],
        "reference": [_text_of("pipeline/data/verification/hybrid3.toml")],
        "regulation": [_text_of(f"pipeline/data/regulations/572.{part}.toml") for part in (33, 123, 133)],
        "results": [json.dumps(TABLES), json.dumps(VERIFICATION, indent=1)],
        "settings": SETTINGS,
        "study": [part for text in studies + [study] for part in _tables_of(_beside(text))]
                 + ['include = ["hybrid3_c.toml"]\n[modes]\ncount = 3\n'],
        "survey": [NASTRAN, UNIVERSAL],
        "table": [sound_files.PULSE, "#b\nt [s], a [gn], b [m/s^2]\r\n# c\r\n\r\n0, 1, 2\r\n1, 2, 3",
                  _text_of("pipeline/data/models/sled_pulse.csv")],
    }
    seeds = {target: [text.encode() for text in each] for target, each in texts.items()}
    seeds["quantity"] = _quantities(studies + models)
    seeds["body"] = [b"\0" + MBDYN.encode(), b"\1" + sid_body().encode()]
    seeds["matrix"] = [b"\0" + MATRIX_MARKET.encode(), b"\1" + petsc, b"\2" + ARRAY.encode(),
                       b"\3" + struct.pack(">2i3d", 1211214, 3, 1, 2, 3)]
    begun = ["$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n$EndNodes\n$Elements\n$EndElements\n",
             UNIVERSAL, NASTRAN, DECK, "ISO-10303-21;\n", "DBRep_DrawableShape\n\nCASCADE Topology V1"]
    seeds["signature"] = [bytes([k]) + text.encode() for k, text in enumerate(begun)]
    for target in ("history", "mesh", "modes"):
        seeds[target] = _scripts()
    return seeds


def words(target):
    """What stands in quotes in the sources of a reader, and what else its texts are made of."""
    found = set(EXTRA.get(target, []))
    for begin in WORDS.get(target, []):
        folder = os.path.dirname(begin)
        names = [name for name in sorted(os.listdir(os.path.join(ROOT, folder)))
                 if name.endswith(".cpp") and f"{folder}/{name}".startswith(begin)]
        if not names:
            raise SystemExit(f"the dictionary of {target}: there is no source {begin}*.cpp")
        for name in names:
            found.update(re.findall(r'"([\w $*%.-]{2,24})"', _text_of(folder, name)))
    return sorted(found)


def _escaped(word):
    return "".join(chr(byte) if 32 <= byte < 127 and byte not in b'"\\' else f"\\x{byte:02x}"
                   for byte in word.encode("latin-1"))


def write(folder):
    """Makes `folder`/TARGET with the inputs and `folder`/TARGET.dict with the words of each target;
    returns the names of the targets."""
    seeds = inputs()
    for target, each in seeds.items():
        corpus = os.path.join(folder, target)
        os.makedirs(corpus)
        for number, contents in enumerate(each):
            with open(os.path.join(corpus, f"seed-{number}"), "wb") as file:
                file.write(contents)
        with open(os.path.join(folder, target + ".dict"), "w", encoding="ascii") as file:
            file.writelines(f'"{_escaped(word)}"\n' for word in words(target))
    return sorted(seeds)
