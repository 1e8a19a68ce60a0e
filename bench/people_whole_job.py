#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The motex authors
# SPDX-License-Identifier: MIT
"""The whole job of people textures, timed: simulated footage is learned and a 75-second film with transitions is made.

usage: bench/people_whole_job.py MOTEX [FRAMES=9000] [FOLDER]

Prints wall and CPU seconds and peak memory of each stage, the size of the model, and what of the truth the alphabet
found (an occurrence is of the action whose performance it overlaps most; a motif is of its commonest action).
FOLDER: keeps the footage there, and uses it again."""
import collections
import csv
import json
import os
import subprocess
import sys
import tempfile
import time


def run(name, words):
    """The command's JSON, timed."""
    begun = time.time()
    process = subprocess.Popen(words + ["--json", "--quiet"], stdout=subprocess.PIPE)
    text = process.stdout.read()
    _, status, usage = os.wait4(process.pid, 0)
    if status != 0:
        sys.exit(f"{name} failed")
    print(f"{name:10} {time.time() - begun:8.1f} s wall {usage.ru_utime + usage.ru_stime:8.1f} s CPU "
          f"{usage.ru_maxrss / 1024:7.0f} MiB", flush=True)
    return json.loads(text)


def overlap(a, b):
    return max(0, min(a[0] + a[1], b[0] + b[1]) - max(a[0], b[0]))


def compare(performances, motifs):
    found, strangers, classes = 0, 0, collections.defaultdict(collections.Counter)
    hits = []
    for number, motif in enumerate(motifs):
        for span in zip(motif["starts"], motif["lengths"]):
            best = max(performances, key=lambda p: overlap(p[:2], span))
            hits.append((number, best if overlap(best[:2], span) > 0.3 * span[1] else None))
            if hits[-1][1]:
                classes[number][best[2]] += 1
    for number, best in hits:
        main = classes[number].most_common(1)[0][0] if classes[number] else None
        strangers += best is None or best[2] != main
    by_action = collections.defaultdict(collections.Counter)
    for number, best in {(n, b) for n, b in hits if b}:
        by_action[best[2]][number] += 1
    for action in {p[2] for p in performances}:
        total = sum(p[2] == action for p in performances)
        top = by_action[action].most_common(1)[0][1] if by_action[action] else 0
        found += top
        print(f"  {action:12} {top} of {total} in one motif")
    print(f"  {found} of {len(performances)} performances in one motif each; "
          f"{strangers} of {len(hits)} occurrences are strangers")


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    motex, frames = sys.argv[1], sys.argv[2] if len(sys.argv) > 2 else "9000"
    with tempfile.TemporaryDirectory() as scratch:
        folder = sys.argv[3] if len(sys.argv) > 3 else os.path.join(scratch, "scene")
        if not os.path.exists(folder):
            run("simulate", [motex, "people", "simulate", "-o", folder, "--frames", frames])
        model, film = os.path.join(scratch, "actor.motex"), os.path.join(scratch, "film.mp4")
        learned = run("learn", [motex, "people", "learn", os.path.join(folder, "scene.mp4"), "-o", model])
        print("  stages", {k: round(v, 1) for k, v in learned["stage_secs"].items()}, "cuts", learned["cuts"],
              f"{learned['footage_bytes'] / 1e6 / learned['footage_secs']:.3f} MB/s")
        with open(os.path.join(folder, "actions.csv"), encoding="utf-8") as rows:
            performances = [(int(r["start"]), int(r["length"]), r["action"]) for r in csv.DictReader(rows)]
        compare(performances, learned["motifs"])
        played = run("play", [motex, "people", "play", model, "--secs", "75", "--shot-secs", "15", "-o", film,
                              "--background", "#304050"])
        print("  cuts in the film", len(played["cuts"]))


main()
