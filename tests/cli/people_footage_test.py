# SPDX-FileCopyrightText: 2026 The motex authors
# SPDX-License-Identifier: MIT
"""What is measured in footage: motex people signals, and people motifs of a video, on a simulated puppet."""

import csv
import functools
import tempfile
import unittest
from pathlib import Path

from command import CommandTest, run


@functools.cache
def scene():
    """A film of left and right kicks as bytes, and when they were performed."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name) / "scene"
        result = run("people", "simulate", "-o", folder, "--frames", "500", "--width", "160", "--height", "120",
                     "--frames-per-sec", "20", "--actions", "left_kick,right_kick", "--noise", "1", "--unevenness", "0",
                     "--spill", "0")
        if result.returncode != 0:
            raise RuntimeError(result.stderr)
        return (folder / "scene.mp4").read_bytes(), list(csv.DictReader((folder / "actions.csv").read_text().splitlines()))


class Footage(CommandTest):
    def setUp(self):
        super().setUp()
        data, self.kicks = scene()
        self.film = self.folder / "kicks.mp4"
        self.film.write_bytes(data)

    def test_signals_are_a_table_and_a_plot(self):
        table, plot = self.folder / "s.csv", self.folder / "s.svg"
        report = self.one_json_object("people", "signals", self.film, "-o", table, "-o", plot, "--show", "aspect,mu30")
        rows = list(csv.DictReader(table.read_text().splitlines()))
        self.assertEqual(report["frames"], 500)
        self.assertEqual(len(rows), 500)
        self.assertEqual([row["frame"] for row in rows[:3]], ["0", "1", "2"])
        for row in rows:
            self.assertAlmostEqual(float(row["aspect"]), float(row["width"]) / float(row["height"]), 6)
        self.assertIn("<svg", plot.read_text())
        standing = sum(float(row["aspect"]) for row in rows[:5]) / 5
        for kick in self.kicks:
            middle = int(kick["start"]) + int(kick["length"]) // 2
            widest = max(float(row["aspect"]) for row in rows[middle - 8:middle + 8])
            self.assertGreater(widest, 1.15 * standing, "a kick makes the box wider")

    def test_motifs_of_a_video(self):
        picture = self.folder / "m.png"
        report = self.one_json_object("people", "motifs", self.film, "--window", "24", "--picture", picture)
        self.assertGreaterEqual(len(report["motifs"]), 1)
        self.assertEqual(picture.read_bytes()[:4], b"\x89PNG")
        for motif in report["motifs"]:
            for start, length in zip(motif["starts"], motif["lengths"]):
                self.assertGreaterEqual(start, 0)
                self.assertLessEqual(start + length, report["frames"])

    def test_the_papers_search_of_a_video(self):
        picture = self.folder / "m.svg"
        report = self.one_json_object("people", "motifs", self.film, "--paper", "--picture", picture)
        self.assertEqual([search["window"] for search in report["searches"]], [40, 80, 160])
        for search in report["searches"]:
            self.assertGreaterEqual(search["distance_found"], search["distance_exact"] - 1e-9)
            self.assertAlmostEqual(search["found_over_exact"], search["distance_found"] / search["distance_exact"], 6)
        self.assertIn("40 frames, iteration 100", picture.read_text())

    def test_a_series_draws_its_motifs_and_collisions(self):
        table, picture = self.folder / "s.csv", self.folder / "p.svg"
        self.succeed("people", "signals", self.film, "-o", table)
        words = ("people", "motifs", table, "--column", "aspect", "--window", 24)
        report = self.one_json_object(*words, "--paper", "--picture", picture)
        self.assertEqual(report["signal"], "aspect")
        self.assertLessEqual(report["searches"][0]["found_over_exact"], 1.05)
        self.assertIn("24 frames, iteration 25", picture.read_text())
        for motif in report["motifs"]:
            self.assertEqual(motif["count"], len(motif["starts"]))
        self.fail_with(2, *words, "--picture", picture, saying="--force")
        self.succeed(*words, "--picture", picture, "--force")
        self.assertNotIn("iteration", picture.read_text())

    def test_bad_requests(self):
        table = self.folder / "s.csv"
        for words, saying in [
            (("people", "signals", self.folder / "none.mp4", "-o", table), "none.mp4"),
            (("people", "signals", self.film, "-o", self.folder / "s.pdf"), "pdf"),
            (("people", "signals", self.film, "-o", self.folder / "s.svg", "--show", "colour"), "colour"),
            (("people", "signals", self.film, "-o", table, "--smooth-secs", "9"), "smooth"),
            (("people", "motifs", self.film, "--profile", self.folder / "p.csv"), "SERIES"),
            (("people", "motifs", self.film, "--picture", self.folder / "m.bmp"), "bmp"),
            (("people", "motifs", self.film, "--paper", "--window", "300"), "too short for two windows of 300 frames"),
        ]:
            self.fail_with(2, *words, saying=saying)
        table.write_text("kept")
        self.fail_with(2, "people", "signals", self.film, "-o", table, saying="--force")
        self.assertEqual(table.read_text(), "kept")
        self.succeed("people", "signals", self.film, "-o", self.folder / "new.csv", "--dry-run")
        self.assertFalse((self.folder / "new.csv").exists())


if __name__ == "__main__":
    unittest.main()
