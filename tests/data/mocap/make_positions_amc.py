#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The motex authors
# SPDX-License-Identifier: MIT
"""World positions of the ends of the bones of an ASF/AMC clip by 3 x 3 matrices, written apart from motex to check it.

make_positions_amc.py FILE.asf FILE.amc   prints lines FRAME BONE x y z (end of the bone; of the root: its place)
For CMU's files: degrees, axis order XYZ.
"""
import sys

import numpy as np


def about(axis, degrees):
    a = np.radians(degrees)
    k = np.zeros((3, 3))
    k[(axis + 2) % 3, (axis + 1) % 3], k[(axis + 1) % 3, (axis + 2) % 3] = 1, -1
    return np.eye(3) + np.sin(a) * k + (1 - np.cos(a)) * k @ k  # Rodrigues


def xyz(angles):
    return about(2, angles[2]) @ about(1, angles[1]) @ about(0, angles[0])


def skeleton(path):
    bones, parents, bone, section = {}, {}, None, ""
    for line in open(path):
        word = line.split()
        if not word or word[0].startswith("#"):
            continue
        if word[0].startswith(":"):
            section = word[0]
        elif section == ":bonedata":
            if word[0] == "begin":
                bone = {"dof": []}
            elif word[0] == "end":
                bones[bone["name"][0]] = bone
            else:
                bone[word[0]] = word[1:]
        elif section == ":hierarchy" and word[0] not in ("begin", "end"):
            parents.update({child: word[0] for child in word[1:]})
    return bones, parents


def main():
    bones, parents = skeleton(sys.argv[1])
    frame, poses = None, []
    for line in open(sys.argv[2]):
        word = line.split()
        if line[0] in "#:":
            continue
        if len(word) == 1:
            poses.append({})
        else:
            poses[-1][word[0]] = [float(x) for x in word[1:]]
    for frame, pose in enumerate(poses):
        root = pose["root"]
        turn, end = {"root": xyz(root[3:])}, {"root": np.array(root[:3])}
        for name, parent in parents.items():
            bone, angles = bones[name], [0.0, 0.0, 0.0]
            for dof, value in zip(bone["dof"], pose.get(name, [])):
                angles["xyz".index(dof[1])] = value
            c = xyz([float(x) for x in bone["axis"][:3]])
            turn[name] = turn[parent] @ c @ xyz(angles) @ np.linalg.inv(c)
            direction = np.array([float(x) for x in bone["direction"]])
            direction *= float(bone["length"][0]) / np.linalg.norm(direction)
            end[name] = end[parent] + turn[name] @ direction
        for name in end:
            print(frame, name, *("%.9g" % x for x in end[name]))


if __name__ == "__main__":
    main()
