# SPDX-FileCopyrightText: 2026 The motex authors
# SPDX-License-Identifier: MIT
"""The same seed gives the same bytes: run after run, for any number of threads, with g++ and with clang."""

import os
import unittest
from pathlib import Path

from command import CLIPS, MOTEX, CommandTest


class MadeTwice:
    """made() twice."""

    def assert_same(self, a, b):
        self.assertEqual(set(a), set(b))
        for name in sorted(a):
            self.assertTrue(a[name] == b[name], f"{name} differs")

    def test_other_compiler(self):
        other = os.environ.get("MOTEX_OTHER_COMPILER", "")
        if not Path(other).is_file():
            self.assertFalse(os.environ.get("MOTEX_REQUIRE_ALL"), f"no command of the other compiler at '{other}'")
            self.skipTest("build it with: scripts/build clang motex_cli")
        self.assert_same(self.made("first"), self.made("second", binary=other))


class SameBytes(MadeTwice, CommandTest):
    def made(self, name, binary=MOTEX, jobs=1, seed=5, learn_options=()):
        """Bytes of the model and of what it dances, as BVH and GLB."""
        folder = self.folder / name
        folder.mkdir()
        model = folder / "dance.motex"
        self.succeed("motion", "learn", *CLIPS, "-o", model, "--seed", seed, "--jobs", jobs, *learn_options, binary=binary)
        for out in ("dance.bvh", "dance.glb"):
            arguments = ("-o", folder / out, "--secs", 30, "--seed", seed, "--jobs", jobs)
            self.succeed("motion", "synthesize", model, *arguments, binary=binary)
        return {path.name: path.read_bytes() for path in folder.iterdir()}

    def test_again_and_with_two_threads(self):
        self.assert_same(self.made("first"), self.made("second", jobs=2))

    def test_own_basis_with_two_threads(self):
        own = ("--basis", "own")
        self.assert_same(self.made("first", learn_options=own), self.made("second", jobs=2, learn_options=own))

    def test_another_seed_dances_otherwise(self):
        self.assertNotEqual(self.made("first")["dance.bvh"], self.made("second", seed=6)["dance.bvh"])


class SameParticles(MadeTwice, CommandTest):
    def made(self, name, binary=MOTEX, jobs=1, seed=5):
        """Bytes of a scene, of the model learned from it and of what that makes."""
        folder = self.folder / name
        folder.mkdir()
        common = ("--seed", seed, "--jobs", jobs)
        small = ("--width", 96, "--height", 72, "--frames", 16)
        for kind, elements in (("snow", 20), ("birds", 6)):
            scene, model = folder / f"{kind}_scene", folder / f"{kind}.motex"
            self.succeed("particles", "simulate", kind, "-o", scene, *small, "--elements", elements, *common, binary=binary)
            self.succeed("particles", "learn", f"{kind}_scene/scene.mkv", "-o", model, *common, binary=binary, cwd=folder)
            self.succeed("particles", "tracks", model, "-o", folder / f"{kind}.csv", *common[2:], binary=binary)
            for appearance in ("replay", "templates"):
                arguments = ("-o", folder / f"{kind}_{appearance}.mkv", "--frames", 20, "--appearance", appearance)
                self.succeed("particles", "synthesize", model, *arguments, *common, binary=binary)
        return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}

    def test_with_two_threads(self):
        self.assert_same(self.made("first"), self.made("second", jobs=2))


class SamePeople(MadeTwice, CommandTest):
    def made(self, name, binary=MOTEX, jobs=1, seed=5):
        """Bytes of a scene, of the actor learned from it and of a film with its cuts."""
        folder = self.folder / name
        folder.mkdir()
        common = ("--seed", seed, "--jobs", jobs)
        scene = ("--size", "240x160", "--frames", 300, "--actions", "left_kick,right_kick", "--repetitions", 2)
        self.succeed("people", "simulate", "-o", folder / "actor", *scene, *common, "--lossless", binary=binary)
        self.succeed("people", "learn", "actor/scene.mkv", "-o", "actor.motex", *common[2:], binary=binary, cwd=folder)
        arguments = ("-o", folder / "film.mkv", "--edits", folder / "film.json", "--frames", 90, *common)
        self.succeed("people", "play", folder / "actor.motex", *arguments, binary=binary)
        return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}

    def test_with_two_threads(self):
        self.assert_same(self.made("first"), self.made("second", jobs=2))


if __name__ == "__main__":
    unittest.main()
