# SPDX-License-Identifier: GPL-3.0-or-later
"""Damage to files: of any bytes, of the numbers and lines of a text, of an HDF5 file's fields."""

import re
import struct

NUMBERS = ["0", "-1", "1", "2", "7", "-7", "1e300", "-1e300", "1e-300", "nan", "inf", "-inf", "1e9",
           "2147483647", "-2147483648", "4294967296", "9223372036854775807", "18446744073709551616",
           "0.5", "1e", "0x10", "1,5", "", "9" * 400]
WORDS = 'aA0_-."\'[]{}()=#*$%&/\\,;:\n\t \x00\x1b\xff'
FIELDS = [0, 1, 2, 3, 7, 8, 0x7F, 0x80, 0xFF, 0x100, 0xFFFF, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF,
          1 << 40, (1 << 63) - 1, 1 << 63, (1 << 64) - 1]
DOUBLES = [float("nan"), float("inf"), -float("inf"), 0.0, -0.0, -1.0, 1e300, -1e300, 5e-324]
# Marks of the structures of an HDF5 file.
SIGNATURES = rb"\x89HDF|OHDR|OCHK|TREE|SNOD|HEAP|GCOL|FRHP|FHDB|FHIB|BTHD|BTLF|FADB|FAHD|EAHD|FSHD"
NUMBER = re.compile(rb"[-+]?\d+\.?\d*(?:[eE][-+]?\d+)?")


def _place(random, data):
    return random.randrange(len(data)) if data else 0


def flip_bit(random, data):
    place = _place(random, data)
    data[place] ^= 1 << random.randrange(8)


def flip_bits(random, data):
    for _ in range(random.randrange(2, 32)):
        flip_bit(random, data)


def set_byte(random, data):
    data[_place(random, data)] = random.choice([0, 1, 0x20, 0x2D, 0x39, 0x7F, 0x80, 0xFE, 0xFF])


def truncate(random, data):
    del data[_place(random, data):]


def _range(random, data):
    begin = _place(random, data)
    return begin, min(len(data), begin + random.choice([1, 2, 4, 8, 16, 64, 256, 4096]))


def cut_out(random, data):
    begin, end = _range(random, data)
    del data[begin:end]


def zero_out(random, data):
    begin, end = _range(random, data)
    data[begin:end] = bytes(end - begin)


def repeat(random, data):
    begin, end = _range(random, data)
    data[begin:begin] = data[begin:end] * random.choice([1, 1, 2, 100])


def copy_elsewhere(random, data):
    begin, end = _range(random, data)
    piece = data[begin:end]
    place = _place(random, data)
    data[place:place + len(piece)] = piece


def insert_noise(random, data):
    place = _place(random, data)
    data[place:place] = random.randbytes(random.choice([1, 4, 16, 256]))


def change_number(random, data):
    found = list(NUMBER.finditer(data))
    if not found:
        return
    match = random.choice(found)
    data[match.start():match.end()] = random.choice(NUMBERS).encode()


def change_numbers(random, data):
    for _ in range(random.randrange(2, 8)):
        change_number(random, data)


def swap_numbers(random, data):
    found = list(NUMBER.finditer(data))
    if len(found) < 2:
        return
    first, second = sorted(random.sample(found, 2), key=lambda match: match.start())
    a, b = bytes(first.group()), bytes(second.group())
    data[second.start():second.end()] = a
    data[first.start():first.end()] = b


def _lines(random, data, change):
    lines = bytes(data).split(b"\n")
    change(lines, random.randrange(len(lines)), random.randrange(len(lines)))
    data[:] = b"\n".join(lines)


def drop_line(random, data):
    _lines(random, data, lambda lines, i, j: lines.pop(i))


def repeat_line(random, data):
    _lines(random, data, lambda lines, i, j: lines.insert(j, lines[i]))


def swap_lines(random, data):
    def swap(lines, i, j):
        lines[i], lines[j] = lines[j], lines[i]
    _lines(random, data, swap)


def move_block(random, data):
    def move(lines, i, j):
        block = lines[i:i + 10]
        del lines[i:i + 10]
        lines[j:j] = block
    _lines(random, data, move)


def insert_characters(random, data):
    place = _place(random, data)
    text = "".join(random.choice(WORDS) for _ in range(random.choice([1, 1, 2, 40])))
    data[place:place] = text.encode("latin-1")


def change_field(random, data):
    """An integer of 1 to 8 bytes near a signature of HDF5, where sizes, counts and addresses are."""
    found = [match.start() for match in re.finditer(SIGNATURES, data)] or [0]
    width = random.choice([1, 2, 4, 8])
    place = min(random.choice(found) + random.randrange(0, 160), max(0, len(data) - width))
    value = random.choice([*FIELDS, len(data), len(data) - 1, random.choice(found)])
    data[place:place + width] = (value & ((1 << 8 * width) - 1)).to_bytes(width, "little")


def change_fields(random, data):
    for _ in range(random.randrange(2, 6)):
        change_field(random, data)


def change_double(random, data):
    place = 8 * random.randrange(max(1, len(data) // 8))
    data[place:place + 8] = struct.pack("<d", random.choice(DOUBLES))


def change_integer(random, data):
    place = 4 * random.randrange(max(1, len(data) // 4))
    value = random.choice([-1, 0, 1, 2, 1 << 30, (1 << 31) - 1, -(1 << 31)])
    data[place:place + 4] = struct.pack("<i", value)


def without_user_block(_random, data):
    """As another writer would make it: HDF5 alone, without the hash that stands before it."""
    begin = data.find(b"\x89HDF\r\n\x1a\n")
    if begin > 0:
        del data[:begin]


ANY = [flip_bit, flip_bits, set_byte, truncate, cut_out, zero_out, repeat, copy_elsewhere,
       insert_noise]
TEXT = [change_number, change_number, change_numbers, swap_numbers, drop_line, repeat_line,
        swap_lines, move_block, insert_characters]
HDF5 = [change_field, change_field, change_fields, change_double, change_integer]


def damage(random, contents, is_text, is_hdf5):
    """The damaged contents and what was done to them."""
    data = bytearray(contents)
    done = []
    if is_hdf5 and random.random() < 0.8:
        without_user_block(random, data)
        done.append("without_user_block")
    own = TEXT if is_text else HDF5 if is_hdf5 else [change_double, change_integer, change_number]
    for _ in range(random.choice([1, 1, 1, 2, 3])):
        mutation = random.choice(random.choice([ANY, own, own]))
        mutation(random, data)
        done.append(mutation.__name__)
    return bytes(data), done
