# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads modes.xdmf as ParaView would: python3 check_xdmf.py modes.xdmf

Fails unless the XML parses, each dataset that it names exists with the extents that it says, and each
grid shows every mode of modes.h5 under its name with its own shape.
"""
import os
import sys
import xml.etree.ElementTree as ElementTree

import h5py


def dataset_of(item, folder):
    name, dataset = item.text.split(":")
    values = h5py.File(os.path.join(folder, name), "r")[dataset]
    assert values.shape == tuple(int(n) for n in item.get("Dimensions").split()), item.text
    kind = "f" if item.get("NumberType") == "Float" else "i"
    assert values.dtype.kind == kind and values.dtype.itemsize == int(item.get("Precision")), item.text
    return values[:]


path = sys.argv[1]
folder = os.path.dirname(path)
modes = h5py.File(os.path.join(folder, "modes.h5"), "r")
names = list(modes["mode_names"].asstr()[:])
grids = ElementTree.parse(path).getroot().find("Domain/Grid").findall("Grid")
view = h5py.File(os.path.join(folder, "mesh_view.h5"), "r")
assert len(grids) == sum(len(part) for part in view["parts"].values())
for grid in grids:
    topology = grid.find("Topology")
    elements = dataset_of(topology[0], folder)
    assert len(elements) == int(topology.get("NumberOfElements"))
    positions = dataset_of(grid.find("Geometry")[0], folder)
    assert (positions == modes["nodes"][:]).all() and elements.max() < len(positions)
    attributes = grid.findall("Attribute")
    assert [a.get("Name") for a in attributes] == names
    for k, attribute in enumerate(attributes):
        assert attribute.get("AttributeType") == "Vector" and attribute.get("Center") == "Node"
        assert (dataset_of(attribute[0], folder) == modes["shapes"][k]).all()
