#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The motex authors
# SPDX-License-Identifier: MIT
"""World positions of BVH joints and end sites by 4 x 4 matrices, written apart from motex to check it.

make_positions.py FRAME,FRAME,... FILE.bvh...   prints, for each file and frame, a line
  FILE FRAME x y z x y z ...                    (joints in the file's order, then end sites)
FRAME may be negative (from the end) or "all".
"""
import os
import re
import sys

import numpy as np


def rotation(axis, degrees):
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    m = np.eye(4)
    a, b = [(1, 2), (2, 0), (0, 1)][axis]
    m[a, a] = m[b, b] = c
    m[b, a], m[a, b] = s, -s
    return m


def translation(x, y, z):
    m = np.eye(4)
    m[:3, 3] = x, y, z
    return m


def parse(path):
    text = open(path, newline=None, encoding="latin-1").read()
    head, motion = re.split(r"^\s*MOTION\s*$", text, maxsplit=1, flags=re.M)
    nodes, stack = [], []  # node: [parent, offset, channels or None for a tip]
    for line in head.splitlines():
        word = line.split()
        if not word:
            continue
        if word[0] in ("ROOT", "JOINT", "End"):
            nodes.append([stack[-1] if stack else None, None, None if word[0] == "End" else []])
            pending = len(nodes) - 1
        elif word[0] == "{":
            stack.append(pending)
        elif word[0] == "}":
            stack.pop()
        elif word[0] == "OFFSET":
            nodes[stack[-1]][1] = [float(x) for x in word[1:4]]
        elif word[0] == "CHANNELS":
            nodes[stack[-1]][2] = word[2:]
    rows = motion[motion.index("Frame Time"):].split("\n", 1)[1]
    count = sum(len(n[2]) for n in nodes if n[2] is not None)
    return nodes, np.array(rows.split(), dtype=float).reshape(-1, count)


def positions(nodes, row):
    world, joints, tips, at = [], [], [], 0
    for parent, offset, channels in nodes:
        place, turn = list(offset), np.eye(4)
        for channel in channels or []:
            axis = "XYZ".index(channel[0])
            if channel[1:] == "position":
                place[axis] = row[at]
            else:
                turn = turn @ rotation(axis, row[at])
            at += 1
        above = np.eye(4) if parent is None else world[parent]
        world.append(above @ translation(*place) @ turn)
        (tips if channels is None else joints).append(world[-1][:3, 3])
    return np.array(joints + tips).reshape(-1)


def main():
    for path in sys.argv[2:]:
        nodes, rows = parse(path)
        frames = range(len(rows)) if sys.argv[1] == "all" else [int(f) % len(rows) for f in sys.argv[1].split(",")]
        for frame in sorted(set(frames)):
            values = " ".join("%.9g" % x for x in positions(nodes, rows[frame]))
            print(os.path.basename(path), frame, values)


if __name__ == "__main__":
    main()
