# SPDX-FileCopyrightText: 2026 The motex authors
# SPDX-License-Identifier: MIT
"""motex particles synthesize: three files together, edits, and how it takes bad requests."""

import json
import struct
import unittest
import zlib

from command import CommandTest, snow_bytes


def write_gray(path, width, height, level):
    """A PNG file; level(x, y) → 0 … 255."""
    rows = b"".join(b"\0" + bytes(level(x, y) for x in range(width)) for y in range(height))
    chunks = [(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)), (b"IDAT", zlib.compress(rows)), (b"IEND", b"")]
    path.write_bytes(
        b"\x89PNG\r\n\x1a\n"
        + b"".join(
            struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data)) for kind, data in chunks
        )
    )
    return path


class Synthesize(CommandTest):
    def setUp(self):
        super().setUp()
        self.snow = self.folder / "snow.motex"
        self.snow.write_bytes(snow_bytes())
        self.video = self.folder / "o.mp4"

    def synthesize(self, *words, output=None):
        return self.one_json_object("particles", "synthesize", self.snow, "-o", output or self.video, *words)

    def rows(self, name="o.tracks.csv"):
        lines = (self.folder / name).read_text().splitlines()
        self.assertEqual(lines[0], "track,frame,x,y,scale,angle,amplitude")
        return [tuple(map(float, line.split(","))) for line in lines[1:]]

    def test_three_files(self):
        report = self.synthesize("--frames", "20")
        self.assertEqual(report["frames"], 20)
        self.assertEqual(self.files(), ["o.layer.mov", "o.mp4", "o.tracks.csv", "snow.motex"])
        rows = self.rows()
        self.assertAlmostEqual(len(rows) / 20, report["elements_per_frame"], places=6)
        self.assertLess(abs(report["elements_per_frame"] / report["learned_elements_per_frame"] - 1), 0.4)
        self.assertTrue(all(-0.5 <= x < 71.5 and -0.5 <= y < 53.5 for _, _, x, y, *_ in rows))
        self.assertEqual({track for track, *_ in rows} - {float(int(track)) for track, *_ in rows}, set())

    def test_same_seed_same_bytes(self):
        names = ["o.mp4", "o.tracks.csv", "o.layer.mov"]
        self.synthesize("--frames", "6", "--seed", "5")
        first = [(self.folder / name).read_bytes() for name in names]
        self.synthesize("--frames", "6", "--seed", "5", "--force", "--jobs", "1")
        self.assertEqual(first, [(self.folder / name).read_bytes() for name in names])
        self.synthesize("--frames", "6", "--seed", "6", "--force")
        self.assertNotEqual(first[1], (self.folder / "o.tracks.csv").read_bytes())

    def test_nothing_is_overwritten_and_nothing_is_written_in_part(self):
        layer = self.folder / "o.layer.mov"
        layer.write_text("old")
        words = ("particles", "synthesize", self.snow, "-o", self.video, "--frames", "3")
        self.fail_with(2, *words, saying="o.layer.mov: exists; --force")
        self.assertEqual(layer.read_text(), "old")
        self.succeed(*words, "--dry-run", "--force")
        self.assertEqual(self.files(), ["o.layer.mov", "snow.motex"])
        self.succeed(*words, "--force")
        self.assertNotEqual(layer.read_bytes(), b"old")

    def test_pictures_and_other_formats(self):
        self.synthesize("--frames", "3", "--scale", "0.5", output=self.folder / "f_%02d.png")
        self.synthesize("--frames", "3", "--style", "cartoon", output=self.folder / "drawn")
        self.synthesize("--frames", "3", "--style", "symbolic", output=self.folder / "w.webm")
        self.assertEqual(
            self.files(),
            ["drawn", "drawn.layer.mov", "drawn.tracks.csv", "f.layer.mov", "f.tracks.csv", "f_00.png", "f_01.png", "f_02.png",
             "snow.motex", "w.layer.mov", "w.tracks.csv", "w.webm"],
        )
        self.assertEqual(len(list((self.folder / "drawn").iterdir())), 3)
        self.fail_with(2, "particles", "synthesize", self.snow, "-o", self.folder / "f_%02d.png", "--frames", "3", "--force",
                       "--scale", "0", saying="scale")

    def test_maps_and_edits(self):
        where = write_gray(self.folder / "where.png", 36, 27, lambda x, y: 255 if 10 <= x < 16 and 10 <= y < 16 else 0)
        self.synthesize("--frames", "30", "--source-map", where)
        born = {}
        for track, frame, x, y, *_ in self.rows():
            born.setdefault(track, (frame, x, y))
        late = [(x, y) for frame, x, y in born.values() if frame > 0]
        self.assertTrue(late and all(18 <= x <= 33 and 18 <= y <= 33 for x, y in late), late)
        black = write_gray(self.folder / "black.png", 8, 8, lambda x, y: 0)
        self.fail_with(2, "particles", "synthesize", self.snow, "-o", self.folder / "b.mp4", "--frames", "9", "--source-map",
                       black, saying="black")

        self.synthesize("--from", "learned", "--force")
        before = self.rows()
        first = before[0]
        edits = self.folder / "edits.json"
        edits.write_text(json.dumps({
            "move": [{"track": first[0], "dx": 1.5, "dy": 0}],
            "remove": [before[1][0], 99999],
            "insert": [{"frame": 2, "x": 30, "y": 20, "vx": 1, "vy": 1}],
        }))
        result = self.succeed("particles", "synthesize", self.snow, "-o", self.video, "--from", "learned", "--edits", edits,
                              "--force")
        self.assertIn("99999", result.stderr)
        after = self.rows()
        self.assertAlmostEqual(next(row for row in after if row[0] == first[0])[2], first[2] + 1.5, places=3)
        self.assertFalse([row for row in after if row[0] == before[1][0]])
        self.assertEqual([row[1:4] for row in after if row[0] == 1e9][:1], [(2.0, 30.0, 20.0)])

    def test_painted_hazard(self):
        kept = write_gray(self.folder / "kept.png", 72, 54, lambda x, y: 0)
        deadly = write_gray(self.folder / "deadly.png", 72, 54, lambda x, y: 255 if y > 30 else 0)
        self.synthesize("--frames", "40", "--hazard-map", kept)
        many = sum(y > 40 for _, _, _, y, *_ in self.rows())
        self.synthesize("--frames", "40", "--hazard-map", deadly, "--force")
        self.assertLess(sum(y > 40 for _, _, _, y, *_ in self.rows()), many / 2)
        self.fail_with(2, "particles", "synthesize", self.snow, "-o", self.folder / "b.mp4", "--frames", "9", "--hazard-map",
                       kept, "--sink-map", deadly, saying="--sink-map and --hazard-map exclude")

    def test_no_births(self):
        result = self.succeed("particles", "synthesize", self.snow, "-o", self.video, "--frames", "3", "--rate", "0")
        self.assertIn("nothing is in the picture", result.stderr)
        self.assertEqual(self.rows(), [])

    def test_bad_requests(self):
        text = self.folder / "text.json"
        text.write_text("no edits")
        for words, saying in [
            ([], "--frames N or --secs S missing"),
            (["--frames", "3", "--secs", "1"], "twice"),
            (["--frames", "-3"], "--frames"),
            (["--frames", "3", "--wind", "1"], "X,Y"),
            (["--frames", "3", "--rate", "-1"], "rate"),
            (["--frames", "3", "--source-map", self.folder / "none.png"], "none.png"),
            (["--frames", "3", "--source-map", text], "text.json"),
            (["--frames", "3", "--edits", text], "JSON object"),
            (["--frames", "3", "--template", "77"], "template 77"),
            (["--frames", "3", "--template", self.folder / "other.motex"], "other.motex"),
            (["--frames", "3", "--background", "#12"], "#12"),
            (["--frames", "3", "--style", "oil"], "oil"),
            (["--frames", "3", "--three-d", "--style", "cartoon"], "three-d"),
            (["--from", "learned", "--loop"], "learned"),
        ]:
            self.fail_with(2, "particles", "synthesize", self.snow, "-o", self.video, *words, saying=saying)
        for output, saying in [("o.txt", "txt"), ("o.png", "numbered"), ("none/o.mp4", "none")]:
            self.fail_with(2, "particles", "synthesize", self.snow, "-o", self.folder / output, "--frames", "3", saying=saying)
        self.fail_with(2, "particles", "synthesize", self.folder / "x.mp4", "-o", self.video, "--frames", "3", saying="x.mp4")


if __name__ == "__main__":
    unittest.main()
