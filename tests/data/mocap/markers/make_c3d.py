#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The motex authors
# SPDX-License-Identifier: MIT
"""usage: make_c3d.py   write made_*.c3d beside this file, from the format's description, independent of motex

Five markers A, B, C, D, E over six frames at 50 Hz in mm, z up; marker m of frame t lies at
  x = 10 m + t, y = -5 m + 0.5 t, z = 1000 - 100 m + 0.25 t
and is missing where (m + t) % 7 == 3. A sixth point, KNEE, is an angle. Two analog channels of three samples a frame.
made_many.c3d: 300 markers P0 … P299 (LABELS and LABELS2), one frame, the same places, none missing, no axes stated.
"""

import struct
from pathlib import Path

FOLDER = Path(__file__).resolve().parent
PROCESSORS = {"intel": 84, "dec": 85, "sgi": 86}


class Writer:
    def __init__(self, order):
        self.order = order

    def word(self, value):
        return struct.pack(">h" if self.order == "sgi" else "<h", value if value < 32768 else value - 65536)

    def real(self, value):
        if self.order == "intel":
            return struct.pack("<f", value)
        if self.order == "sgi":
            return struct.pack(">f", value)
        # VAX F: exponent 2 higher, the halves in Intel order each, the upper first
        upper, lower = struct.unpack(">HH", struct.pack(">f", value * 4))
        return struct.pack("<HH", upper, lower)

    def record(self, name, group, body):
        return bytes([len(name), group & 255]) + name.encode() + self.word(len(body) + 2) + body

    def group(self, number, name):
        return self.record(name, -number, b"\x05group")  # the description is "group"

    def parameter(self, group, name, kind, sizes, data):
        return self.record(name, group, bytes([kind & 255, len(sizes), *sizes]) + data + b"\0")

    def texts(self, group, name, values, width):
        return self.parameter(group, name, -1, [width, len(values)], "".join(v.ljust(width) for v in values).encode())


def padded(data):
    return data + bytes(-len(data) % 512)


def place(m, t):
    return 10 * m + t, -5 * m + 0.5 * t, 1000 - 100 * m + 0.25 * t


def file_bytes(order, scale, names, num_frames, num_analog, records, missing):
    writer = Writer(order)
    is_real = scale < 0

    def section(data_block):
        point = [
            writer.group(1, "POINT"),
            writer.parameter(1, "USED", 2, [], writer.word(len(names))),
            writer.parameter(1, "SCALE", 4, [], writer.real(scale)),
            writer.parameter(1, "RATE", 4, [], writer.real(50)),
            writer.parameter(1, "FRAMES", 2, [], writer.word(num_frames)),
            writer.parameter(1, "DATA_START", 2, [], writer.word(data_block)),
            writer.parameter(1, "UNITS", -1, [2], b"mm"),
        ]
        body = b"".join(point + records(writer)) + b"\0\0"
        size = (len(body) + 4 + 511) // 512
        return padded(bytes([1, 80, size, PROCESSORS[order]]) + body)

    data_block = 2 + len(section(0)) // 512
    header = bytes([2, 80]) + writer.word(len(names)) + writer.word(num_analog) + writer.word(1) + writer.word(num_frames)
    header += writer.word(10) + writer.real(scale) + writer.word(data_block) + writer.word(num_analog // 2) + writer.real(50)
    number = writer.real if is_real else lambda value: writer.word(round(value))
    data = b""
    for t in range(num_frames):
        for m in range(len(names)):
            if missing(m, t):
                data += number(0) * 3 + number(-1)
            else:
                data += b"".join(number(x if is_real else x / scale) for x in place(m, t)) + number(0)
        data += b"".join(number(100 + k) for k in range(num_analog))
    return padded(header) + section(data_block) + padded(data)


def small_records(writer):
    return [
        writer.texts(1, "LABELS", ["A", "B", "C", "D", "E", "KNEE"], 6),
        writer.texts(1, "ANGLES", ["KNEE"], 8),
        writer.parameter(1, "X_SCREEN", -1, [2], b"+X"),
        writer.parameter(1, "Y_SCREEN", -1, [2], b"+Z"),
        writer.group(2, "ANALOG"),
        writer.parameter(2, "USED", 2, [], writer.word(2)),
    ]


def many_records(writer):
    names = [f"P{k}" for k in range(300)]
    return [writer.texts(1, "LABELS", names[:255], 4), writer.texts(1, "LABELS2", names[255:], 4)]


def main():
    small = ["A", "B", "C", "D", "E", "KNEE"]
    for order in PROCESSORS:
        for kind, scale in (("int", 0.25), ("real", -0.25)):
            made = file_bytes(order, scale, small, 6, 6, small_records, lambda m, t: (m + t) % 7 == 3)
            (FOLDER / f"made_{order}_{kind}.c3d").write_bytes(made)
    many = file_bytes("intel", -1, [f"P{k}" for k in range(300)], 1, 0, many_records, lambda m, t: False)
    (FOLDER / "made_many.c3d").write_bytes(many)


if __name__ == "__main__":
    main()
