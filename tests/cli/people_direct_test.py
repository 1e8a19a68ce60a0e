# SPDX-FileCopyrightText: 2026 The motex authors
# SPDX-License-Identifier: MIT
"""Films of an actor: motex people direct and play, on a simulated puppet."""

import functools
import json
import tempfile
import unittest
from pathlib import Path

from command import CommandTest, run


@functools.cache
def actor():
    """A model learned from a simulated puppet, and the letters of its actions."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for words in [
            ("simulate", "-o", folder / "scene", "--frames", "700", "--width", "160", "--height", "120", "--frames-per-sec",
             "20", "--noise", "1", "--unevenness", "0", "--spill", "0"),
            ("learn", folder / "scene" / "scene.mp4", "-o", folder / "actor.motex"),
        ]:
            result = run("people", *words)
            if result.returncode != 0:
                raise RuntimeError(f"{words}: {result.stderr}")
        info = json.loads(run("people", "info", folder / "actor.motex", "--json").stdout)
        return (folder / "actor.motex").read_bytes(), [motif["letter"] for motif in info["motifs"]]


class Film(CommandTest):
    def setUp(self):
        super().setUp()
        data, self.letters = actor()
        self.assertGreaterEqual(len(self.letters), 2)
        self.actor = self.folder / "actor.motex"
        self.actor.write_bytes(data)

    def test_script_becomes_a_film_and_edit_lists(self):
        a, b = self.letters[:2]
        report = self.one_json_object("people", "direct", self.actor, "--script", f"{a} x2, {b}", "-o", self.folder / "f.mkv",
                                      "--edits", self.folder / "f.json", "--edits", self.folder / "f.otio")
        motifs = [performance["motif"] for performance in report["performances"]]
        self.assertEqual(motifs, [a, a, b])
        edits = json.loads((self.folder / "f.json").read_text())
        self.assertEqual(edits["frames"], report["frames"])
        self.assertEqual(sum(shot["last"] - shot["first"] + 1 for shot in edits["shots"]), report["frames"])
        self.assertEqual(len(edits["cuts"]), len(edits["shots"]) - 1)
        timeline = json.loads((self.folder / "f.otio").read_text())
        self.assertEqual(timeline["OTIO_SCHEMA"], "Timeline.1")
        clips = [c for c in timeline["tracks"]["children"][0]["children"] if c["OTIO_SCHEMA"] == "Clip.2"]
        self.assertEqual(len(clips), len(edits["shots"]))
        again = self.one_json_object("people", "direct", self.actor, "--from-edits", self.folder / "f.json", "-o",
                                     self.folder / "g.mkv")
        self.assertEqual(again["frames"], report["frames"])
        self.assertEqual((self.folder / "g.mkv").read_bytes(), (self.folder / "f.mkv").read_bytes())

    def test_play_has_the_length_asked_for_and_the_seed_decides(self):
        reports = {}
        for seed in [1, 1, 2]:
            target = self.folder / f"{len(reports)}-{seed}.mkv"
            report = self.one_json_object("people", "play", self.actor, "--secs", 6, "--shot-secs", 1.5, "--seed", seed, "-o",
                                          target, "--transition-frames", 2)
            self.assertEqual(report["frames"], 120)
            reports.setdefault(seed, set()).add(target.read_bytes())
            target.unlink()
        self.assertEqual(len(reports[1]), 1)
        self.assertNotEqual(reports[1], reports[2])

    def test_choices_are_performed(self):
        commands = f"@20 {self.letters[1]}\n# nothing\n{self.letters[0]}\n@200 stop\n"
        choices = self.folder / "choices.txt"
        choices.write_text(commands)
        with open(choices, encoding="utf-8") as lines:
            result = self.succeed("people", "play", self.actor, "--steer", "--frames", 300, "-o", self.folder / "p.mkv", "--json",
                                  stdin=lines)
        report = json.loads(result.stdout)
        self.assertEqual(report["frames"], 200)
        self.assertEqual([p["motif"] for p in report["performances"]][:2], [self.letters[1], self.letters[0]])

    def test_bad_requests(self):
        film, script = self.folder / "x.mov", self.letters[0]
        direct = ("people", "direct", self.actor)
        beats = self.folder / "beats.txt"
        beats.write_text("0.5\n0.2\n")
        for words, saying in [
            ((*direct, "-o", film), "--script"),
            ((*direct, "--script", "somersault", "-o", film), f"'somersault' is no motif; there are {script}"),
            ((*direct, "--script", "", "-o", film), "--script"),
            ((*direct, "--script", script, "-o", self.folder / "x.mp4"), "alpha.*--background"),
            ((*direct, "--script", script, "-o", self.folder / "x.txt"), "x.txt"),
            ((*direct, "--script", script, "-o", film, "--edits", self.folder / "x.edl"), r"\.otio"),
            ((*direct, "--script", script, "-o", film, "--beats", beats), "beats.txt"),
            ((*direct, "--script", script, "-o", film, "--background", self.folder / "no.png"), "no.png"),
            ((*direct, "--from-edits", beats, "-o", film), "beats.txt"),
            (("people", "play", self.actor, "-o", film), "--frames"),
            (("people", "play", self.actor, "-o", film, "--secs", -1), "secs|length"),
            (("people", "play", beats, "-o", film, "--secs", 1), "beats.txt"),
        ]:
            self.fail_with(2, *words, saying=saying)

    def test_nothing_is_overwritten_without_force(self):
        film = self.folder / "x.mkv"
        film.write_text("old")
        for words in [("direct", self.actor, "--script", self.letters[0]), ("play", self.actor, "--frames", "20")]:
            self.fail_with(2, "people", *words, "-o", film, saying="--force")
            self.assertEqual(film.read_text(), "old")
            before = self.files()
            self.succeed("people", *words, "-o", self.folder / "new.mkv", "--dry-run")
            self.assertEqual(self.files(), before)


if __name__ == "__main__":
    unittest.main()
