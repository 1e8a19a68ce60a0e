#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The motex authors
# SPDX-License-Identifier: MIT
"""Does another dance follow when a model is edited? Steps danced before and after against what the chain says, time of
preferred, rare and dropped textons, smoothness, and how much a dance from two mixed models visits each.

usage: motion_edits.py [DATA_FOLDER]   the command is $MOTEX, else build/release/motex
"""

import collections
import json
import math
import os
import subprocess
import tempfile
from pathlib import Path

from command_under_test import MOTEX, data_folder

SECS = int(os.environ.get("SECS", "1200"))
MOST_STEPS = int(os.environ.get("STEPS", "10"))  # the commonest ones are weighed


def motex(*words):
    done = subprocess.run([MOTEX, "motion", *map(str, words), "--json", "--quiet"], stdout=subprocess.PIPE, check=True)
    return json.loads(done.stdout)


class Dance:
    def __init__(self, model, folder, seed=1):
        report = motex("synthesize", model, "-o", folder / "dance.npz", "--secs", SECS, "--seed", seed, "--force", "--no-foot-fix")
        path = report["path"]
        self.steps = collections.Counter(zip(path, path[1:]))
        self.left = collections.Counter(path[:-1])
        self.frames = collections.Counter()
        for instance in report["instances"]:
            self.frames[instance["texton"]] += instance["length"]
        self.total = sum(self.frames.values())
        self.path = path

    def share(self, step):
        return self.steps[step] / max(1, self.left[step[0]])

    def time(self, texton):
        return self.frames[texton] / self.total


def probability(model, a, b):
    following = motex("texton", "list", model)["textons"][a]["next"]
    return next((n["probability"] for n in following if n["texton"] == b), 0.0)


def weigh_steps(model, folder, before):
    edited = folder / "edited.motex"
    steps = [s for s, n in before.steps.most_common() if s[0] != s[1] and probability(model, *s) < 0.6][:MOST_STEPS]
    for factor in (10, 0.1, 0):
        sums = collections.Counter()
        for a, b in steps:
            motex("texton", "weight", model, "--from", a, "--to", b, "--factor", factor, "-o", edited, "--force")
            after = Dance(edited, folder)
            row = {"chain": probability(model, a, b), "chain'": probability(edited, a, b), "danced": before.share((a, b)),
                   "danced'": after.share((a, b))}
            print(f"  {a:3d} → {b:3d} × {factor:<4}  " + "  ".join(f"{k} {v:.3f}" for k, v in row.items()))
            sums.update(row)
        print(f"× {factor}: means of {len(steps)} steps  " + "  ".join(f"{k} {v / len(steps):.3f}" for k, v in sums.items()))


def weigh_textons(model, folder, before):
    edited = folder / "edited.motex"
    for texton in [t for t, _ in before.frames.most_common(4)]:
        times = []
        for factor in (5, 0.2):
            motex("texton", "weight", model, "--to", texton, "--factor", factor, "-o", edited, "--force")
            times.append(Dance(edited, folder).time(texton))
        motex("texton", "drop", model, texton, "-o", edited, "--force")
        times.append(Dance(edited, folder).time(texton))
        print(f"texton {texton:3d}: share of time {before.time(texton):.3f}; preferred × 5 {times[0]:.3f}, × 0.2 {times[1]:.3f}, "
              f"dropped {times[2]:.3f}")


def smoothness(model, folder, name):
    motex("synthesize", model, "-o", folder / "dance.bvh", "--secs", 120, "--seed", 3, "--force")
    value = motex("compare", "--reference", *CLIPS, "--generated", folder / "dance.bvh")
    print(f"{name}: " + ", ".join(f"{k} {value[k]:.2f}" for k in ("jerk_ratio", "pose_jump_ratio", "contact_speed_ratio")))


def mix(folder):
    subjects = [[c for c in CLIPS if c.name.startswith(s)] for s in ("cmu60", "cmu61")]
    if not all(subjects):
        subjects = [CLIPS[:1], CLIPS[1:]]
    models = [folder / "a.motex", folder / "b.motex"]
    for clips, model in zip(subjects, models):
        motex("learn", *clips, "-o", model)
    mixed = folder / "mixed.motex"
    report = motex("mix", *models, "-o", mixed)
    first = report["textons_of_b"][0]
    for seed in (1, 2, 3):
        dance = Dance(mixed, folder, seed)
        of_a = sum(n for t, n in dance.frames.items() if t < first) / dance.total
        crossings = sum((a < first) != (b < first) for a, b in zip(dance.path, dance.path[1:]))
        print(f"mixed, seed {seed}: {100 * of_a:.0f} % of the time in A, {crossings} crossings in {len(dance.path)} textons; "
              f"nearest across {report['crossing_distance_cm']:.1f} cm, within {report['usual_distance_cm']:.1f} cm")
    smoothness(mixed, folder, "mixed")


if __name__ == "__main__":
    salsa = data_folder() / "salsa"
    CLIPS = sorted((salsa if salsa.is_dir() else data_folder() / "quickstart").glob("*.bvh"))
    with tempfile.TemporaryDirectory() as name:
        scratch = Path(name)
        learned = scratch / "all.motex"
        motex("learn", *CLIPS, "-o", learned)
        first_dance = Dance(learned, scratch)
        entropy = -sum(n / first_dance.total * math.log(n / first_dance.total) for n in first_dance.frames.values())
        print(f"{len(CLIPS)} clips, {len(first_dance.frames)} textons danced in {SECS} s, entropy of their times {entropy:.2f} nats")
        weigh_steps(learned, scratch, first_dance)
        weigh_textons(learned, scratch, first_dance)
        smoothness(learned, scratch, "as learned")
        step = first_dance.steps.most_common(1)[0][0]
        motex("texton", "weight", learned, "--from", step[0], "--to", step[1], "--factor", 10)
        motex("texton", "drop", learned, first_dance.frames.most_common(2)[1][0])
        smoothness(learned, scratch, "a step preferred, a texton dropped")
        mix(scratch)
