# SPDX-FileCopyrightText: 2026 The motex authors
# SPDX-License-Identifier: MIT
"""Gaps filled, textons on beats, loops, several dancers, play speed."""

import json
import unittest

from command import CLIPS, CommandTest


class Inbetween(CommandTest):
    def fill(self, *more, model=None, start=f"{CLIPS[0]}@200", end=f"{CLIPS[0]}@231", frames=30):
        return ("motion", "inbetween", model or self.model(), "--from", start, "--to", end, "--frames", frames, *more)

    def test_gap_and_joined(self):
        out = self.folder / "x.bvh"
        value = json.loads(self.succeed(*self.fill("-o", out, "--json")).stdout)
        self.assertEqual((value["frames"], value["gap_start"]), (30, 0))
        self.assertIn("Frames: 30", out.read_text())
        value = json.loads(self.succeed(*self.fill("-o", out, "--json", "--join", "--force")).stdout)
        self.assertEqual(value["gap_start"], 201)
        self.assertGreater(value["frames"], 260)

    def test_clips_of_the_model_by_name_and_another_rate(self):
        name = CLIPS[0].rsplit("/", 1)[1].removesuffix(".bvh")
        self.succeed(*self.fill("-o", self.folder / "a.bvh", start=f"{name}@100", end=f"{name}@140"))
        model = self.folder / "slow.motex"
        self.succeed("motion", "learn", *CLIPS, "-o", model, "--resample", 30)
        result = self.succeed(*self.fill("-o", self.folder / "b.bvh", model=model, frames=15))
        self.assertIn("Hz", result.stderr)

    def test_bad_requests(self):
        out = self.folder / "x.bvh"
        for words, saying in [
            (self.fill("-o", out, frames=0), "1 to"),
            (self.fill("-o", out, frames=100000), "longer"),
            (self.fill("-o", out, start=CLIPS[0]), "CLIP@FRAME"),
            (self.fill("-o", out, start=f"{CLIPS[0]}@99999999"), "frames 0"),
            (self.fill("-o", out, start="nobody@3"), "no clip nobody"),
            (self.fill("-o", out, end=f"{self.folder}/none.bvh@3"), "none.bvh"),
        ]:
            self.fail_with(2, *words, saying=saying)
            self.assertFalse(out.exists())


class Music(CommandTest):
    def synthesize(self, *more):
        return ("motion", "synthesize", self.model(), *more)

    def test_textons_begin_on_beats(self):
        beats = self.folder / "beats.csv"
        beats.write_text("secs\n" + "\n".join(f"{0.3 + 0.55 * k:.3f}" for k in range(60)) + "\n")
        value = json.loads(self.succeed(*self.synthesize("-o", self.folder / "x.bvh", "--secs", 30, "--beats", beats, "--json")).stdout)
        self.assertLessEqual(value["beats"]["median_offset_frames"], 1)
        self.assertGreaterEqual(value["beats"]["share_on_beat"], 0.9)

    def test_a_loop(self):
        value = json.loads(self.succeed(*self.synthesize("-o", self.folder / "x.bvh", "--frames", 300, "--loop", "--json")).stdout)
        self.assertEqual(value["frames"], 300)
        self.assertLess(value["seam_ratio"], 1.2)

    def test_dancers_and_threads(self):
        for jobs in (1, 3):
            (self.folder / str(jobs)).mkdir()
            out = self.folder / str(jobs) / "x.bvh"
            self.succeed(*self.synthesize("-o", out, "-o", self.folder / str(jobs) / "x.glb", "--secs", 3, "--dancers", 3, "-j", jobs))
        for name in ("x-1.bvh", "x-2.bvh", "x-3.bvh", "x.glb"):
            self.assertEqual((self.folder / "1" / name).read_bytes(), (self.folder / "3" / name).read_bytes())
        self.assertNotEqual((self.folder / "1" / "x-1.bvh").read_bytes(), (self.folder / "1" / "x-2.bvh").read_bytes())
        self.fail_with(2, *self.synthesize("-o", self.folder / "1" / "x.bvh", "--secs", 3, "--dancers", 2), saying="--force")

    def test_bad_requests(self):
        out, noise = self.folder / "x.bvh", self.folder / "noise.wav"
        noise.write_bytes(b"no sound")
        words = self.folder / "words.txt"
        words.write_text("1\ntwo\n")
        for more, saying in [
            (("--speed", 9), "speed"),
            (("--dancers", 0), "dancers"),
            (("--loop-step", "1,2,3"), "--loop"),
            (("--loop", "--loop-step", "1,2"), "X,Z,HEADING"),
            (("--loop", "--path", "0,1"), "--loop"),
            (("--beats", noise), "noise.wav"),
            (("--beats", words), "words.txt:2"),
            (("--beats", self.folder / "none.txt"), "none.txt"),
        ]:
            self.fail_with(2, *self.synthesize("-o", out, "--secs", 5, *more), saying=saying)
            self.assertFalse(out.exists())


if __name__ == "__main__":
    unittest.main()
