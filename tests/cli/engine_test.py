# SPDX-FileCopyrightText: 2026 The motex authors
# SPDX-License-Identifier: MIT
"""What an engine gets: the pack of clips with its graph, the steered stream, motion on another body."""

import json
import math
import random
import signal
import subprocess
import time
import unittest

from command import CLIPS, DATA, MOTEX, CommandTest, run, write_cut

OTHER_BODY = DATA / "wild" / "positions_everywhere_dance_24hz_12_frames.bvh"


class Pack(CommandTest):
    def test_a_reader_can_walk_the_graph(self):
        pack = self.folder / "pack"
        self.succeed("motion", "texton", "name", self.model(), 0, "first turn")
        value = self.one_json_object("motion", "export", self.folder / "dance.motex", "-o", pack, "--bvh")
        graph = json.loads((pack / "graph.json").read_text())
        self.assertEqual(graph["motex_graph"], 1)
        clips = {clip["name"]: clip for clip in graph["clips"]}
        self.assertEqual(list(clips), value["clips"])
        self.assertIn("first_turn", clips)
        follows = {}
        for edge in graph["transitions"]:
            self.assertIn(edge["to"], clips)
            follows.setdefault(edge["from"], []).append(edge)
        rng = random.Random(1)
        name, x, z, heading, secs = next(iter(follows)), 0.0, 0.0, 0.0, 0.0
        for _ in range(200):
            clip = clips[name]
            root = clip["root_motion"]
            x += math.cos(heading) * root["x"] + math.sin(heading) * root["z"]
            z += -math.sin(heading) * root["x"] + math.cos(heading) * root["z"]
            heading += math.radians(root["turn_degrees"])
            secs += (clip["frames"] - graph["overlap_frames"]) / graph["frame_rate"]
            edges = follows[name]
            self.assertAlmostEqual(sum(edge["probability"] for edge in edges), 1, places=6)
            name = rng.choices([edge["to"] for edge in edges], [edge["probability"] for edge in edges])[0]
        self.assertGreater(secs, 100)
        self.assertTrue(math.isfinite(x + z))
        for clip in graph["clips"]:
            frames = next(line for line in (pack / f"{clip['name']}.bvh").read_text().splitlines() if line.startswith("Frames:"))
            self.assertEqual(int(frames.split()[1]), clip["frames"])

    def test_nothing_is_overwritten(self):
        pack = self.folder / "pack"
        model = self.model()
        self.succeed("motion", "export", model, "-o", pack, "--dry-run")
        self.assertFalse(pack.exists())
        self.succeed("motion", "export", model, "-o", pack)
        self.fail_with(2, "motion", "export", model, "-o", pack, saying="--force")
        self.succeed("motion", "export", model, "-o", pack, "--force")


class Stream(CommandTest):
    def play(self, *arguments, commands=None):
        return self.succeed("motion", "play", self.model(), "--no-pacing", *arguments,
                            **({} if commands is None else {"input": commands, "stdin": None}))

    def test_json_lines(self):
        lines = [json.loads(line) for line in self.play("--frames", 90).stdout.splitlines()]
        head, frames = lines[0], lines[1:]
        self.assertEqual(head["motex_stream"], 1)
        self.assertEqual([frame["frame"] for frame in frames], list(range(90)))
        for frame in frames:
            self.assertEqual(len(frame["rotations"]), len(head["joints"]))
            self.assertAlmostEqual(sum(c * c for c in frame["rotations"][3]), 1, places=4)
            self.assertGreaterEqual(frame["texton"], 0)

    def test_csv(self):
        rows = [line.split(",") for line in self.play("--frames", 5, "--format", "csv").stdout.splitlines()]
        self.assertEqual(len(rows), 6)
        self.assertEqual({len(row) for row in rows}, {len(rows[0])})
        self.assertEqual(rows[0][:4], ["frame", "time", "texton", "root.x"])

    def test_commands(self):
        script = "# a comment\ndirection 90\n@60 speed 0.5\n@100 nonsense\n@120 texton 1\n@600 stop\n"
        result = self.play("--steer", commands=script)
        self.assertEqual(len(result.stdout.splitlines()), 601)
        self.assertIn("nonsense", result.stderr)
        self.assertEqual(result.stdout, self.play("--steer", commands=script).stdout)
        self.assertNotEqual(result.stdout, self.play("--steer", commands="@600 stop\n").stdout)
        textons = {json.loads(line)["texton"] for line in result.stdout.splitlines()[120:]}
        self.assertIn(1, textons)

    def test_it_goes_where_it_is_sent(self):
        frames = self.play("--steer", "--format", "csv", commands="direction 90\n@1800 stop\n").stdout.splitlines()[1:]
        first, last = (list(map(float, frames[t].split(",")[3:6])) for t in (300, 1799))
        angle = math.degrees(math.atan2(last[0] - first[0], last[2] - first[2]))
        self.assertLess(abs((angle - 90 + 180) % 360 - 180), 35)

    def test_the_end_of_commands_is_the_end(self):
        self.assertLess(len(self.play("--steer", commands="direction 10\n").stdout.splitlines()), 10)

    def test_nobody_reads(self):
        process = subprocess.Popen([MOTEX, "motion", "play", self.model()], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                   bufsize=0)
        process.stdout.readline()
        process.stdout.close()
        self.assertEqual(process.wait(timeout=60), 0)
        self.assertNotIn(b"error", process.stderr.read())
        process.stderr.close()

    def test_interrupt(self):
        process = subprocess.Popen([MOTEX, "motion", "play", self.model()], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                   bufsize=0)
        begun = process.stdout.readline() + process.stdout.readline()
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 0, err)
        for line in (begun + out).splitlines():
            json.loads(line)

    def test_real_time(self):
        start = time.monotonic()
        self.succeed("motion", "play", self.model(), "--secs", 1)
        self.assertGreater(time.monotonic() - start, 0.9)

    def test_bad_requests(self):
        model = self.model()
        for words, saying in [(("--frames", 0), "--frames"), (("--no-pacing",), "--frames"), (("--json", "--frames", 3), "--json"),
                              (("--max-turn", -3, "--frames", 3), "max-turn|max_turn"), (("--format", "xml", "--frames", 3), "--format")]:
            self.fail_with(2, "motion", "play", model, *words, saying=saying)


class Retarget(CommandTest):
    def test_map_written_and_read_again(self):
        clip = write_cut(CLIPS[0], self.folder / "clip.bvh", 200)
        other = self.folder / "other.bvh"
        text = (self.folder / "clip.bvh").read_text()
        for old, new in [("lThigh", "LeftUpLeg"), ("rThigh", "RightUpLeg"), ("lShin", "LeftLeg"), ("rShin", "RightLeg")]:
            text = text.replace(old, new)
        other.write_text(text)
        first, second = self.folder / "a.bvh", self.folder / "b.bvh"
        for target in (self.folder / "map.csv", self.folder / "map.json"):
            self.succeed("motion", "retarget", clip, "--to", other, "--write-map", target)
            self.assertIn("LeftUpLeg", target.read_text())
        value = self.one_json_object("motion", "retarget", clip, "--to", other, "-o", first)
        self.assertEqual(value["unmatched"], [])
        self.assertEqual(value["map"]["LeftLeg"], "lShin")
        self.assertLess(value["max_direction_error_degrees"], 1e-5)
        self.succeed("motion", "retarget", clip, "--to", other, "-o", second, "--map", self.folder / "map.csv")
        self.assertEqual(first.read_bytes(), second.read_bytes())

    def test_dry_run_prints_the_pairs(self):
        clip = write_cut(CLIPS[0], self.folder / "clip.bvh", 30)
        before = self.files()
        result = self.succeed("motion", "retarget", clip, "--to", clip, "--dry-run")
        self.assertRegex(result.stdout, "rShin +rShin")
        self.assertEqual(self.files(), before)

    def test_bad_requests(self):
        clip = write_cut(CLIPS[0], self.folder / "clip.bvh", 30)
        out = self.folder / "x.bvh"
        bad = self.folder / "bad.csv"
        bad.write_text("Tail,hip\n")
        self.fail_with(2, "motion", "retarget", clip, "--to", clip, saying="-o OUT")
        self.fail_with(2, "motion", "retarget", clip, "--to", clip, "-o", out, "--map", bad, saying="Tail")
        self.fail_with(2, "motion", "retarget", clip, "--to", self.folder / "none.bvh", "-o", out, saying="none.bvh")
        self.fail_with(2, "motion", "retarget", clip, "--to", clip, "-o", out, "--target-pose", 99, saying="frame 99")
        self.fail_with(2, "motion", "retarget", clip, "--to", clip, "-o", out, "--target-pose", "x", saying="--target-pose")
        chain = DATA / "synthetic" / "ok_reference.bvh"
        self.assertIn(run("motion", "retarget", clip, "--to", chain, "--dry-run").returncode, (0, 2))


if __name__ == "__main__":
    unittest.main()
