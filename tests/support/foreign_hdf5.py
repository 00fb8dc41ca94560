# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes HDF5 files as other programs might: python3 foreign_hdf5.py FOLDER

foreign.h5 has numbers and strings of other kinds than ours, which are read, and data that are not in the
file or more than it holds, which are refused.
"""
import sys

import h5py
import numpy

folder = sys.argv[1]
with h5py.File(folder + "/other.h5", "w") as other:
    other["values"] = [1.0, 2.0]

with h5py.File(folder + "/foreign.h5", "w") as file:
    file.attrs["format"] = "flexneck example"
    file.attrs["schema_version"] = numpy.int8(2)
    file.attrs["many"] = ["a text"] * 1000
    file.attrs["whole"] = 7800
    file.attrs["huge"] = numpy.uint64(2**64 - 1)
    file["strings/variable"] = ["a", "", "ζ"]
    file["strings/zeros"] = numpy.array([b"ab", b"c"], dtype="S5")
    spaces = h5py.h5t.C_S1.copy()
    spaces.set_size(4)
    spaces.set_strpad(h5py.h5t.STR_SPACEPAD)
    padded = h5py.h5d.create(file.id, b"/strings/spaces", spaces, h5py.h5s.create_simple((2,)))
    padded.write(h5py.h5s.ALL, h5py.h5s.ALL, numpy.array([b"ab  ", b"c d "], dtype="S4"), spaces)
    for kind in ("i1", "u2", ">i4", "i8", "u8"):
        file["integers/" + kind] = numpy.array([1, 100], dtype=kind)
    file["integers/beyond"] = numpy.array([1, 2**31])
    file["integers/unsigned"] = numpy.array([1, 2**64 - 1], dtype="u8")

    def double(name, **options):
        file.create_dataset(name, **options).attrs["units"] = numpy.string_("m")

    values = numpy.arange(1000.0)
    double("doubles/single", data=values.astype("f4"))
    double("doubles/swapped", data=values.astype(">f8"))
    double("doubles/gzip", data=values, compression="gzip", shuffle=True, fletcher32=True)
    double("refused/lzf", data=values, compression="lzf")
    double("refused/unwritten", shape=(1000,), dtype="f8")
    double("refused/holes", shape=(1000,), chunks=(10,), dtype="f8")
    file["refused/holes"][0:500] = 1
    double("refused/giant", shape=(10**11,), chunks=(10**6,), dtype="f8", compression="gzip")
    double("refused/outside", shape=(2,), dtype="f8", external=[(folder + "/raw", 0, 16)])
    layout = h5py.VirtualLayout(shape=(2,), dtype="f8")
    layout[:] = h5py.VirtualSource(folder + "/other.h5", "values", shape=(2,))
    file.create_virtual_dataset("refused/virtual", layout)
    file["refused/link"] = h5py.ExternalLink(folder + "/other.h5", "/values")
    file["refused/circle"] = h5py.SoftLink("/refused/circle")
