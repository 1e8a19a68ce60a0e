#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The motex authors
# SPDX-License-Identifier: MIT
"""Times the command itself, start to file on disk: learning all the dance, and dancing 10,000 frames on one core.

usage: motion_commands.py [DATA_FOLDER]   the command is $MOTEX, else build/release/motex
"""

import json
import os
import resource
import statistics
import subprocess
import tempfile
import time
from pathlib import Path

from command_under_test import MOTEX, data_folder

FRAMES = 10000
REPEATS = 7


def timed(*command):
    """Wall clock and processor seconds of a command, and its JSON."""
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    done = subprocess.run([*map(str, command), "--json", "--force", "--quiet"], stdout=subprocess.PIPE, check=True)
    wall, after = time.monotonic() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
    return wall, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, json.loads(done.stdout)


def learn(clips, model, basis, repeats=3):
    walls, cpus = [], []
    for _ in range(repeats):
        wall, cpu, report = timed(MOTEX, "motion", "learn", clips, "-o", model, "--basis", basis)
        walls.append(wall)
        cpus.append(cpu)
    print(
        f"learn {clips.name} --basis {basis:6}   {min(walls):6.2f} s best, {statistics.median(walls):6.2f} s median wall, "
        f"{statistics.median(cpus):6.2f} s cpu, {report['peak_rss_mib']:.0f} MiB, {report['frames']} frames, "
        f"{report['textons']} textons, {len(report['log_likelihood'])} iterations"
    )


def synthesize(model, name, out, *options):
    walls, cpus = [], []
    for _ in range(REPEATS):
        command = ("taskset", "-c", "0", MOTEX, "motion", "synthesize", model, "-o", out, "--frames", FRAMES)
        wall, cpu, _ = timed(*command, "--jobs", 1, *options)
        walls.append(1000 * wall / FRAMES)
        cpus.append(1000 * cpu / FRAMES)
    print(
        f"{name:40} {min(walls):.4f} ms/frame best, {statistics.median(walls):.4f} median wall, "
        f"{statistics.median(cpus):.4f} cpu"
    )


def main():
    data = data_folder()
    clips = next((data / name for name in ("salsa", "quickstart") if (data / name).is_dir()), data)
    print(f"load {os.getloadavg()[0]:.1f}, {os.cpu_count()} cores")
    with tempfile.TemporaryDirectory() as folder:
        own, shared, dance = (Path(folder) / name for name in ("own.motex", "shared.motex", "dance.bvh"))
        print("wanted: own <= 20 s on 2 cores, <= 500 MiB. known: paper 4 h, feasibility 29-41 s")
        learn(clips, own, "own")
        learn(clips, shared, "shared")
        print("wanted: <= 0.03 without and <= 0.06 with the foot pass. known: GenMM 9-10, motion graph 21-27")
        for basis, model in (("shared", shared), ("own", own)):
            synthesize(model, f"{FRAMES} frames to BVH, {basis}, no foot pass", dance, "--no-foot-fix")
            synthesize(model, f"{FRAMES} frames to BVH, {basis}, foot pass", dance)


if __name__ == "__main__":
    main()
