# SPDX-FileCopyrightText: 2026 The motex authors
# SPDX-License-Identifier: MIT
"""motex people simulate, learn, info, name, export and crowd on a simulated puppet."""

import json
import unittest

from command import CommandTest
from people_direct_test import actor


class Simulate(CommandTest):
    WORDS = ("--frames", 60, "--size", "96x64", "--actions", "bow")

    def test_same_seed_same_files(self):
        for name, seed in [("a", 3), ("b", 3), ("c", 4)]:
            self.succeed("people", "simulate", "-o", self.folder / name, *self.WORDS, "--seed", seed)
        for file in ["scene.mp4", "matte.mkv", "actions.csv", "truth.json", "screen.png"]:
            self.assertEqual((self.folder / "a" / file).read_bytes(), (self.folder / "b" / file).read_bytes(), file)
        self.assertNotEqual((self.folder / "a" / "scene.mp4").read_bytes(), (self.folder / "c" / "scene.mp4").read_bytes())

    def test_bad_requests(self):
        out = self.folder / "x"
        for words, saying in [
            (("--actions", "bow,somersault"), "somersault"),
            (("--frames", 50, "--repetitions", 9), "--repetitions"),
            (("--size", "96"), "--size"),
            (("--screen", "red"), "red"),
            (("--persons", 0), "--persons"),
        ]:
            self.fail_with(2, "people", "simulate", "-o", out, *words, saying=saying)
        self.succeed("people", "simulate", "-o", out, *self.WORDS, "--dry-run")
        self.assertFalse(out.exists())


class Model(CommandTest):
    def setUp(self):
        super().setUp()
        data, self.letters = actor()
        self.actor = self.folder / "actor.motex"
        self.actor.write_bytes(data)

    def test_names_are_given_and_taken_away(self):
        a = self.letters[0]
        self.succeed("people", "name", self.actor, a, "high kick", "--dry-run")
        before = self.actor.read_bytes()
        self.succeed("people", "name", self.actor, a, "high kick")
        info = self.one_json_object("people", "info", self.actor)
        self.assertEqual([m["name"] for m in info["motifs"] if m["letter"] == a], ["high kick"])
        self.succeed("people", "name", self.actor, "high kick", "")
        self.assertEqual(self.actor.read_bytes(), before)
        self.fail_with(2, "people", "name", self.actor, "hihg kick", "bow", saying="hihg kick")
        self.fail_with(2, "people", "name", self.actor, a, "one, two", saying="comma")
        self.assertEqual(self.actor.read_bytes(), before)

    def test_learning_refuses_what_is_no_footage(self):
        self.fail_with(2, "people", "learn", self.actor, "-o", self.folder / "x.motex", saying="model")
        self.fail_with(2, "people", "learn", self.folder / "no.mp4", "-o", self.folder / "x.motex", saying="no.mp4")
        self.fail_with(2, "people", "learn", self.folder / "no.mp4", "-o", self.actor, saying="--force")
        self.succeed("people", "simulate", "-o", self.folder / "s", "--frames", 3, "--size", "96x64")
        self.fail_with(2, "people", "learn", self.folder / "s" / "scene.mp4", "-o", self.folder / "x.motex", saying="3 frames")
        self.assertFalse((self.folder / "x.motex").exists())

    def test_sprites_lie_on_their_pages(self):
        self.succeed("people", "export", self.actor, "-o", self.folder / "sprites", "--page-size", 512)
        atlas = json.loads((self.folder / "sprites" / "atlas.json").read_text())
        for page in atlas["pages"]:
            self.assertTrue((self.folder / "sprites" / page["file"]).exists())
        taken = []
        for frame in atlas["frames"]:
            x, y, w, h = frame["x"], frame["y"], frame["width"], frame["height"]
            self.assertLessEqual(max(x + w, y + h), 512)
            for page, u, v, a, b in taken:
                self.assertTrue(page != frame["page"] or u + a <= x or x + w <= u or v + b <= y or y + h <= v)
            taken.append((frame["page"], x, y, w, h))
        letters = [action["letter"] for action in atlas["actions"] if action["letter"]]
        self.assertEqual(sorted(letters), sorted(self.letters))
        self.fail_with(2, "people", "export", self.actor, "-o", self.folder / "y", "--page-size", 64, saying="--page-size")

    def test_a_crowd_has_as_many_as_asked_for(self):
        report = self.one_json_object("people", "crowd", self.actor, "-o", self.folder / "c.mkv", "--secs", 0.5, "--people", 4)
        self.assertEqual(len(report["people"]), 4)
        self.assertEqual(report["frames"], 10)
        scales = [extra["scale"] for extra in report["people"]]
        self.assertEqual(scales, sorted(scales))
        self.fail_with(2, "people", "crowd", self.actor, "-o", self.folder / "c.mp4", "--secs", 1, saying="alpha")

    def test_cues_say_when_each_one_comes(self):
        cues = self.folder / "cues.txt"
        cues.write_text(f"0.25 {self.letters[0]}\n0\n")
        words = ("people", "crowd", self.actor, "-o", self.folder / "c.mkv", "--secs", 0.5, "--people", 2, "--cues", cues)
        self.assertEqual([extra["start"] for extra in self.one_json_object(*words)["people"]], [5, 0])
        cues.write_text("0\nsoon\n")
        self.fail_with(2, *words, "--force", saying=":2")
        cues.write_text("0\n0\n0\n")
        self.fail_with(2, *words, "--force", saying="3 cues")


if __name__ == "__main__":
    unittest.main()
