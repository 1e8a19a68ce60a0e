# SPDX-FileCopyrightText: 2026 The motex authors
# SPDX-License-Identifier: MIT
"""motex people key: what it writes, what it refuses."""

import functools
import json
import shutil
import tempfile
import unittest
from pathlib import Path

from command import CommandTest, run


@functools.cache
def scene():
    folder = Path(tempfile.mkdtemp(prefix="motex_key_"))
    result = run("people", "simulate", "-o", folder / "actor", "--frames", 24, "--size", "161x121", "--lossless")
    if result.returncode != 0:
        raise RuntimeError(result.stderr)
    return folder / "actor"


def tearDownModule():
    shutil.rmtree(scene().parent, ignore_errors=True)


class Key(CommandTest):
    def test_alpha_and_json(self):
        target = self.folder / "keyed.mkv"
        result = json.loads(self.succeed("people", "key", scene() / "scene.mkv", "-o", target, "--json").stdout)
        self.assertEqual(result["frames"], 24)
        self.assertEqual(result["plate"]["kind"], "green")
        self.assertGreater(target.stat().st_size, 1000)

    def test_given_plate_pictures_and_background(self):
        self.succeed("people", "key", scene() / "scene.mkv", "--plate", scene() / "screen.png", "-o", self.folder / "pictures",
                     "-o", self.folder / "f_%03d.png")
        self.assertEqual(len(list((self.folder / "pictures").iterdir())), 24)
        self.succeed("people", "key", scene() / "scene.mkv", "--background", "#203040", "-o", self.folder / "shown.mp4")

    def test_a_dry_run_writes_nothing(self):
        before = self.files()
        self.succeed("people", "key", scene() / "scene.mkv", "-o", self.folder / "x.mov", "--dry-run")
        self.assertEqual(self.files(), before)

    def test_bad_requests(self):
        clip, out = scene() / "scene.mkv", self.folder / "x.mov"
        for words, saying in [
            ((clip, "-o", self.folder / "x.mp4"), "keeps no alpha"),
            ((clip, "-o", out, "-o", out), "twice"),
            ((clip, "-o", out, "--tolerance", -1), "tolerance"),
            ((clip, "-o", out, "--background", "none.png"), "none.png"),
            ((clip, "-o", out, "--plate", clip), "PNG"),
            ((clip, "-o", out, "--garbage-mask", "none.png"), "none.png"),
            ((clip, "-o", out, "--screen", "pink"), "pink"),
            ((scene() / "screen.png", "-o", out), "nobody"),
            (("none.mp4", "-o", out), "none.mp4"),
        ]:
            self.fail_with(2, "people", "key", *words, saying=saying)

    def test_nothing_is_overwritten(self):
        out = self.folder / "x.mkv"
        out.write_text("old")
        self.fail_with(2, "people", "key", scene() / "scene.mkv", "-o", out, saying="--force")
        self.assertEqual(out.read_text(), "old")


if __name__ == "__main__":
    unittest.main()
