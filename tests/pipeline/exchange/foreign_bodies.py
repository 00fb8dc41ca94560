# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads reduced bodies as other programs do: MBDyn's .fem, SID_FEM, Exudyn's HDF5. Each reader gives a Body with the
terms of a floating frame of reference, from the file's own definitions; none knows the program that wrote it."""

import re
from pathlib import Path

import numpy


class Body:
    """mass, S1 (3), J0 (3, 3), S2 (3, m), G0 (m, 3, 3), G (m, m, 3, 3), N0 (3, m), N (m, m, 3), M (m, m), K (m, m)
    and nodes {name: (position, translation (3, m), rotation (3, m))}: equations.md section 2."""


def skew(v):
    return numpy.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])


def mbdyn(path):
    """The modal joint's data: Inv3 = S2, Inv4 = N0, Inv8 = -sum m ~s ~phi_j, Inv5 = sum m phi_j x phi_k,
    Inv9 = sum m ~phi_j ~phi_k."""
    groups, names, group = {}, {}, None
    for line in Path(path).read_text().splitlines():
        found = re.match(r"\*\* RECORD GROUP (\d+)", line)
        if found:
            group = int(found[1])
            groups[group] = []
        elif line.startswith("** END OF FILE"):
            break
        elif line.startswith("** INTERFACE "):
            label, name = line[len("** INTERFACE "):].split(" ", 1)
            names[label] = name
        elif not line.startswith("**"):
            groups[group] += line.split()
    assert groups[1][0] == "REV0"
    n, m = int(groups[1][1]), sum(int(count) for count in groups[1][2:5])
    numbers = {k: numpy.array(v, dtype=float) for k, v in groups.items() if k > 2}
    body = Body()
    places = numpy.array([numbers[k] for k in (5, 6, 7)])
    shapes = numbers[8].reshape(m, n, 6)
    body.nodes = {names.get(label, label): (places[:, k], shapes[:, k, :3].T, shapes[:, k, 3:].T)
                  for k, label in enumerate(groups[2])}
    body.M, body.K = numbers[9].reshape(m, m), numbers[10].reshape(m, m)
    body.mass, center = numbers[12][0], numbers[12][1:4]
    body.S1 = body.mass * center
    body.J0 = numbers[12][4:].reshape(3, 3) - body.mass * skew(center) @ skew(center)
    body.S2, body.N0 = numbers[14].reshape(3, m), numbers[15].reshape(3, m)
    body.G0 = numbers[16].reshape(3, m, 3).transpose(1, 0, 2)
    body.N = numbers[17].reshape(3, m, m).transpose(1, 2, 0)
    body.G = -numbers[18].reshape(3, m, m, 3).transpose(1, 2, 0, 3)
    return body


def sid_blocks(path):
    """{"mdCM": (m0, m1), …} and [(id, {"origin": (m0, m1), …})] of the nodes, and the header; m1 is (nrow, nq, ncol)."""
    lines = [line.strip() for line in Path(path).read_text("latin-1").splitlines()]
    header, blocks, nodes, masses = lines[0], {}, [], []
    name, head = None, {}
    for line in lines[1:]:
        key, _, value = (part.strip() for part in line.partition("="))
        entry = re.match(r"(m[01])\(([\d, ]+)\)$", key)
        if key == "new node":
            nodes.append((value, {}))
        elif key == "mass":
            masses.append(float(value.replace("D", "e")))
        elif key in ("order", "nrow", "ncol", "nq", "nqn", "structure"):
            head[key] = int(value)
            if key == "structure":
                m0 = numpy.zeros((head["nrow"], head["ncol"]))
                if head["structure"] == 4:
                    m0 = numpy.eye(head["nrow"])
                m1 = numpy.zeros((head["nrow"], head["nq"], head["ncol"]))
                place = nodes[-1][1] if name in ("origin", "phi", "psi", "AP") else blocks
                place[name] = (m0, m1)
        elif entry:
            at = tuple(int(index) - 1 for index in entry[2].split(","))
            (m0 if entry[1] == "m0" else m1)[at] = float(value.replace("D", "e"))
        elif re.match(r"[A-Za-z]+$", line):
            name = line
    return header, masses[0], blocks, nodes


def sid(path):
    """What Wallrapp's terms of the generalised inertia and centrifugal forces are made of."""
    header, mass, blocks, nodes = sid_blocks(path)
    names = dict(part.strip().split(" = ") for part in header.split(";")[1:])
    body = Body()
    body.mass = mass
    body.nodes = {names.get(number, number): (node["origin"][0][:, 0], node["phi"][0], node["psi"][0])
                  for number, node in nodes}
    body.M, body.K = blocks["Me"][0], blocks["Ke"][0]
    m = len(body.M)
    body.S1, body.S2 = blocks["mdCM"][0][:, 0], blocks["Ct"][0].T
    xx, yy, zz, xy, xz, yz = blocks["J"][0][:, 0]
    body.J0 = numpy.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    body.N0 = blocks["Cr"][0].T
    body.N = blocks["Cr"][1].transpose(1, 0, 2)
    body.G0 = blocks["Gr"][0].reshape(3, m, 3).transpose(1, 0, 2) / 2
    body.G = numpy.zeros((m, m, 3, 3))
    for k in range(m):
        for l in range(m):
            xx, yy, zz, xy, yz, xz = -blocks["Oe"][1][l, k]
            body.G[k, l] = [[xx, xy / 2, xz / 2], [xy / 2, yy, yz / 2], [xz / 2, yz / 2, zz]]
            body.G[k, l] -= skew(body.N[k, l]) / 2
    return body


def exudyn(path):
    """What ObjectFFRFreducedOrderInterface loads; the last nodes are the interfaces, four each."""
    import h5py

    def loaded(group):
        result = {}
        for key, item in group.items():
            kind = item.attrs["datatype"]
            if isinstance(item, h5py.Group):
                assert kind == "dict", kind
                result[key] = loaded(item)
            else:
                cast = {"int": int, "float": float, "ndarray": numpy.array, "str": lambda text: text.decode("utf-8")}
                result[key] = cast[kind](item[()])
        return result

    with h5py.File(path, "r") as file:
        data = loaded(file)
    assert data["type"] == "ObjectFFRFreducedOrderInterface" and data["fileVersion"] == 1
    assert data["trigList"].tolist() == [] and data["postProcessingModes"] == {}
    assert data["rigidBodyNodeType"] == "NodeType.RotationEulerParameters"
    m, nodes, dim, rotations, rigid, all_of_them = data["infoList"]
    assert (dim, rotations, rigid, all_of_them) == (3, 4, 7, 7 + m)
    body = Body()
    body.M, body.K = data["massMatrixReduced"], data["stiffnessMatrixReduced"]
    body.mass, body.S1 = data["totalMass"], data["totalMass"] * data["chiU"]
    assert numpy.array_equal(data["Mtt"], body.mass * numpy.eye(3))
    body.J0, body.S2, body.N0 = data["inertiaLocal"], data["mPhitTPsi"], -data["mXRefTildePsi"]
    body.G0 = data["mXRefTildePsiTilde"].reshape(3, m, 3).transpose(1, 0, 2)
    body.N = -data["mPsiTildePsi"].reshape(m, 3, m).transpose(0, 2, 1)
    body.G = data["mPsiTildePsiTilde"].reshape(m, 3, m, 3).transpose(0, 2, 1, 3)
    for l in range(m):
        assert numpy.allclose(data["mPhitTPsiTilde"][:, 3 * l:3 * l + 3], skew(body.S2[:, l]), rtol=0, atol=1e-15)
    places = data["xRef"].reshape(nodes, 3)
    shapes = data["modeBasis"].reshape(nodes, 3, m)
    body.places, body.shapes = places, shapes
    body.interface_of = lambda place: rigid_motion(places[place:place + 4], shapes[place:place + 4])
    return body


def rigid_motion(places, shapes):
    """Point, translation and rotation of nodes with equal weights."""
    point = places.mean(axis=0)
    arms = places - point
    turn = numpy.linalg.inv(sum(-skew(arm) @ skew(arm) for arm in arms))
    return point, shapes.mean(axis=0), turn @ sum(skew(arm) @ shape for arm, shape in zip(arms, shapes))
