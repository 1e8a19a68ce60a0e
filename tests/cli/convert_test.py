# SPDX-FileCopyrightText: 2026 The motex authors
# SPDX-License-Identifier: MIT
"""Formats in and out: markers, the options that change what is written, and what is refused."""

import json
import unittest

from command import CLIPS, DATA, CommandTest, write_cut

MARKERS = DATA / "markers"


class Markers(CommandTest):
    def test_info(self):
        value = self.one_json_object("motion", "info", MARKERS / "made_dec_int.c3d")
        self.assertEqual((value["frames"], value["markers"], value["frame_rate"]), (6, 5, 50))
        self.assertAlmostEqual(value["missing_share"], 4 / 30)
        self.assertIn("RFT1", self.succeed("motion", "info", MARKERS / "pc_int.c3d", "--list").stdout)

    def test_every_format_is_written_and_the_readable_ones_are_read_again(self):
        for extension in ["trc", "c3d", "csv", "npz", "html", "png", "svg"]:
            target = self.folder / f"x.{extension}"
            self.succeed("motion", "convert", MARKERS / "pc_real.c3d", "-o", target)
            self.assertGreater(target.stat().st_size, 1000)
        for extension in ["trc", "c3d"]:
            value = self.one_json_object("motion", "info", self.folder / f"x.{extension}")
            self.assertEqual((value["frames"], value["markers"], value["metres_per_unit"]), (89, 36, 0.001))

    def test_view(self):
        page = self.folder / "x.html"
        self.succeed("motion", "view", MARKERS / "opensim_commas_8_frames.trc", "-o", page, "--up", "z")
        data = page.read_text().split('id="motex-data">')[1].split("</script>")[0]
        self.assertEqual(json.loads(data)["numPoints"], 51)

    def test_subset_scale_and_axis(self):
        table = self.folder / "x.csv"
        self.succeed("motion", "convert", MARKERS / "made_sgi_real.c3d", "-o", table, "--joints", "B", "--frames", "1:1",
                     "--scale", 2, "--out-unit", "cm", "--out-up", "z")
        # Marker 1 of frame 1 in mm, z up, is (11, -4.5, 900.25).
        head, row = table.read_text().splitlines()
        self.assertEqual(head, "frame,time,B.X,B.Y,B.Z")
        for cell, wanted in zip(row.split(",")[2:], (2.2, -0.9, 180.05)):
            self.assertAlmostEqual(float(cell), wanted, places=6)

    def test_what_markers_cannot_be(self):
        c3d = MARKERS / "pc_int.c3d"
        self.fail_with(2, "motion", "learn", c3d, "-o", self.folder / "x.motex", saying="markers.*skeleton")
        self.fail_with(2, "motion", "convert", c3d, "-o", self.folder / "x.bvh", saying=r"\.bvh")
        self.fail_with(2, "motion", "convert", c3d, "-o", self.folder / "x.trc", "--root", "in-place", saying="root")
        self.fail_with(2, "motion", "convert", c3d, "-o", self.folder / "x.trc", "--joints", "nobody", saying="nobody")
        self.fail_with(2, "motion", "convert", c3d, "-o", self.folder / "x.c3d", "--out-up", "z", saying="out-up")

    def test_cut_off(self):
        (self.folder / "cut.c3d").write_bytes((MARKERS / "pc_real.c3d").read_bytes()[:70000])
        self.fail_with(2, "motion", "info", self.folder / "cut.c3d", saying=r"cut\.c3d: byte 70000: .*cut off")


class Export(CommandTest):
    def setUp(self):
        super().setUp()
        self.clip = write_cut(CLIPS[0], self.folder / "clip.bvh", 40)

    def rows(self, *options):
        table = self.folder / "x.csv"
        self.succeed("motion", "convert", self.clip, "-o", table, "--force", *options)
        head, *rows = [line.split(",") for line in table.read_text().splitlines()]
        return head, [dict(zip(head, map(float, row))) for row in rows]

    def test_in_place(self):
        head, kept = self.rows()
        _, held = self.rows("--root", "in-place")
        x, y, z = head[2:5]
        self.assertNotEqual(kept[0][x], kept[-1][x])
        for before, after in zip(kept, held):
            self.assertEqual((after[x], after[y], after[z]), (0, before[y], 0))

    def test_root_bone_is_a_joint_of_its_own(self):
        out = self.folder / "x.glb"
        self.succeed("motion", "convert", self.clip, "-o", out, "--root", "bone")
        value = self.one_json_object("motion", "info", out)
        self.assertEqual(value["joint_list"][0], {"name": "root_motion", "parent": None})
        self.assertEqual(value["joint_list"][1]["parent"], "root_motion")

    def test_frames_and_rate(self):
        _, rows = self.rows("--frames", "10:19")
        self.assertEqual(len(rows), 10)
        self.assertEqual(len(self.rows("--frames", "30:")[1]), 10)
        whole = self.one_json_object("motion", "info", self.clip)
        value = self.one_json_object("motion", "convert", self.clip, "-o", self.folder / "y.bvh", "--out-fps", whole["frame_rate"] / 2)
        self.assertEqual(value["frames"], 20)

    def test_written_from_a_model_too(self):
        out = self.folder / "x.bvh"
        self.succeed("motion", "synthesize", self.model(), "-o", out, "--frames", 60, "--root", "in-place", "--scale", 0.5)
        self.assertIn("Frames: 60", out.read_text())

    def test_bad_requests(self):
        def fails(*options, saying, target="y.bvh"):
            self.fail_with(2, "motion", "convert", self.clip, "-o", self.folder / target, *options, saying=saying)

        fails("--out-up", "z", target="y.glb", saying="y up")
        fails("--out-unit", "cm", target="y.glb", saying="metres")
        fails("--joints", "Tail", saying="Tail")
        fails("--without", "*", saying="no joint is left")
        fails("--frames", "40:", saying="40 frames")
        fails("--frames", "5:3", saying="5:3")
        fails("--frames", "x", saying="A:B")
        fails("--scale", "0", saying="scale")


if __name__ == "__main__":
    unittest.main()
