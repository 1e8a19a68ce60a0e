# SPDX-FileCopyrightText: 2026 The motex authors
# SPDX-License-Identifier: MIT
"""Habits that every command keeps: streams, exit codes, JSON, seeds, no overwriting."""

import unittest

from command import CLIPS, CommandTest, commands, run, write_cut

class Usage(CommandTest):
    def test_help_is_data(self):
        nouns = {words[0] for words in commands() if len(words) > 1}
        self.assertLessEqual({"motion", "particles"}, nouns)
        for words in [(), *((noun,) for noun in nouns), *commands()]:
            result = self.succeed(*words, "--help")
            self.assertIn("motex", result.stdout)
            self.assertEqual(result.stderr, "")
        for words in commands():
            text = run(*words, "--help").stdout
            self.assertIn(f"usage: motex {' '.join(words)}", text)
            if len(words) > 1:
                self.assertIn("Examples", text, f"{words} --help has no example")

    def test_every_command_refuses_what_it_does_not_know(self):
        for words in commands():
            self.fail_with(2, *words, "--no-such-flag", saying="no-such-flag")
            if len(words) > 1:
                self.fail_with(2, *words, saying="(?i)missing|at least one|name one|needs|--help")
            self.fail_with(2, *words[:-1], words[-1] + "x", saying=words[-1])

    def test_wrong_usage(self):
        self.fail_with(2, "motion", "lern", saying="lern|learn")
        self.fail_with(2, "motion", "learn", saying="(?i)clip|-o|required|usage|--help")
        self.fail_with(2, "motion", "info", "--no-such-flag", saying="no-such-flag")

    def test_wrong_values(self):
        model = self.model()
        for flag, value in [("--secs", "-3"), ("--secs", "nan"), ("--secs", "x"), ("--frames", "-1"), ("--seed", "x")]:
            arguments = ["motion", "synthesize", model, "-o", self.folder / "x.bvh", flag, value]
            if flag == "--seed":
                arguments += ["--secs", "1"]
            self.fail_with(2, *arguments, saying=flag[2:])

    def test_doctor(self):
        self.succeed("doctor")


class Output(CommandTest):
    def test_nothing_is_overwritten_without_force(self):
        model, old = self.model(), self.folder / "x.bvh"
        old.write_text("old")
        arguments = ("motion", "synthesize", model, "-o", old, "--secs", 1)
        self.fail_with(2, *arguments, saying="--force")
        self.assertEqual(old.read_text(), "old")
        self.succeed(*arguments, "--force")
        self.assertNotEqual(old.read_text(), "old")

    def test_learn_does_not_overwrite_either(self):
        model = self.model()
        before = model.read_bytes()
        self.fail_with(2, "motion", "learn", CLIPS[0], "-o", model, saying="--force")
        self.assertEqual(model.read_bytes(), before)

    def test_dry_run_writes_nothing(self):
        model = self.model()
        before = self.files()
        self.succeed("motion", "synthesize", model, "-o", self.folder / "x.bvh", "--secs", 1, "--dry-run")
        self.succeed("motion", "learn", CLIPS[0], "-o", self.folder / "y.motex", "--dry-run")
        self.assertEqual(self.files(), before)

    def test_particles_overwrite_nothing_and_write_nothing_in_a_dry_run(self):
        model, video = self.snow_model(), self.folder / "v.mkv"
        self.succeed("particles", "synthesize", model, "-o", video, "--frames", 14)
        for words, name in [
            (("learn", video), "l.motex"),
            (("tracks", model), "t.csv"),
            (("tracks", model), "t.xml"),
            (("tracks", model), "t.mkv"),
            (("synthesize", model, "--frames", 3), "s.mkv"),
            (("compress", video, "--model", self.folder / "l.motex"), "c.mtxc"),
            (("decompose", video, "--counts", 5), "d"),
            (("maps", model), "m"),
            (("simulate", "snow", "--frames", 3, "--width", 32, "--height", 24), "snow"),
            (("simulate", "birds", "--frames", 3, "--width", 32, "--height", 24), "birds"),
            (("simulate", "fireworks", "--frames", 3, "--width", 32, "--height", 24), "fireworks"),
        ]:
            before, target = self.files(), self.folder / name
            arguments = ("particles", *words, "-o", target)
            self.succeed(*arguments, "--dry-run")
            self.assertEqual(self.files(), before, words)
            result = self.succeed(*arguments, "--quiet")
            self.assertEqual(result.stderr, "", words)
            kept = self.contents(target)
            self.fail_with(2, *arguments, saying="--force")
            self.assertEqual(self.contents(target), kept, words)
            self.succeed(*arguments, "--force")

    @staticmethod
    def contents(path):
        paths = sorted(path.rglob("*")) if path.is_dir() else [path]
        return [(one.name, one.read_bytes()) for one in paths if one.is_file()]

    def test_quiet_says_nothing(self):
        result = self.succeed("motion", "synthesize", self.model(), "-o", self.folder / "x.bvh", "--secs", 1, "--quiet")
        self.assertEqual((result.stdout, result.stderr), ("", ""))

    def test_no_colour_and_no_progress_off_a_terminal(self):
        result = self.succeed("motion", "synthesize", self.model(), "-o", self.folder / "x.bvh", "--secs", 1)
        self.assertNotRegex(result.stdout + result.stderr, "[\x1b\r]")

    def test_seed_is_said(self):
        result = self.succeed("motion", "synthesize", self.model(), "-o", self.folder / "x.bvh", "--secs", 1, "--seed", 4711)
        self.assertIn("4711", result.stdout + result.stderr)

    def test_every_format_is_written(self):
        model = self.model()
        for extension in ["bvh", "glb", "csv", "npz", "html"]:
            target = self.folder / f"x.{extension}"
            self.succeed("motion", "synthesize", model, "-o", target, "--secs", 2)
            self.assertGreater(target.stat().st_size, 1000)

    def test_every_written_motion_is_read_again(self):
        clip = write_cut(CLIPS[0], self.folder / "clip.bvh", 30)
        for extension in ["bvh", "glb"]:
            target = self.folder / f"again.{extension}"
            self.succeed("motion", "convert", clip, "-o", target)
            self.succeed("motion", "convert", target, "-o", self.folder / f"back_{extension}.bvh")


class Json(CommandTest):
    def has(self, value, *keys):
        self.assertLessEqual(set(keys), set(value), f"missing: {set(keys) - set(value)}")

    def test_learn(self):
        value = self.one_json_object("motion", "learn", CLIPS[0], "-o", self.folder / "x.motex")
        self.has(value, "frames", "clips", "textons", "segments", "log_likelihood", "secs", "peak_rss_mib")
        trace = value["log_likelihood"]
        self.assertEqual(trace, sorted(trace), "the objective never falls")

    def test_info(self):
        self.has(self.one_json_object("motion", "info", self.model()), "textons")

    def test_synthesize(self):
        out = self.folder / "x.bvh"
        value = self.one_json_object("motion", "synthesize", self.model(), "-o", out, "--frames", 500, "--seed", 3)
        self.has(value, "instances", "seed")
        self.assertEqual(value["seed"], 3)
        for instance in value["instances"]:
            self.has(instance, "clip", "start", "length")

    def test_path_and_choreograph(self):
        model, clip = self.model(), CLIPS[0].rsplit("/", 1)[1].removesuffix(".bvh")
        self.one_json_object("motion", "path", model, "--from", 0, "--to", 1)
        poses = ("--start", f"{clip}@10", "--end", f"{clip}@900", "--frames", 600)
        outs = [self.folder / "a.bvh", self.folder / "b.bvh"]
        for out in outs:
            self.one_json_object("motion", "choreograph", model, *poses, "-o", out, "--seed", 2)
        self.assertEqual(outs[0].read_bytes(), outs[1].read_bytes())
        self.assertIn("Frames: 600", outs[0].read_text())
        led = ("--place", "0,0,0", "--at", "599:60,90,45", "--avoid", "500,500,600,600", "--reach", "lHand@300:0,100,0")
        value = self.one_json_object("motion", "choreograph", model, *poses, *led, "-o", self.folder / "led.bvh")
        self.has(value, "root_path", "reached", "frames_below_floor")
        self.has(value["root_path"], "clearance", "way_ratio")

    def test_stretch_vary_and_edit(self):
        model, out = self.model(), self.folder / "x.bvh"
        for words in [
            ("stretch", "--frames", 150),
            ("vary", "--noise", 0.5),
            ("edit", "--turn", "20:head=0,30,0", "--raise", "25=-0.5", "--set", "30:tilt=5,0"),
        ]:
            value = self.one_json_object("motion", *words[:1], model, "--texton", 0, *words[1:], "-o", out, "--force")
            self.has(value, "frames", "clip", "start", "texton", "instance", "seed", "options")
            self.assertIn(f"Frames: {value['frames']}", out.read_text())
            if words[0] == "stretch":
                self.assertEqual(value["frames"], 150)
                self.assertAlmostEqual(value["speed_ratio"], 1, delta=0.05)
            if words[0] == "edit":
                self.assertEqual([part["frames"] for part in value["parts"]], [[25], [30], [20]])

    def test_particles(self):
        model, video, small = self.snow_model(), self.folder / "v.mkv", self.folder / "c.mtxc"
        made = self.one_json_object("particles", "synthesize", model, "-o", video, "--frames", 14, "--seed", 3)
        self.has(made, "output", "frames", "seed", "elements_per_frame", "options", "secs")
        learned = self.one_json_object("particles", "learn", video, "-o", self.folder / "l.motex", "--seed", 3)
        self.has(learned, "model", "frames", "cables", "templates", "learning", "options", "seed", "secs")
        self.assertEqual((made["seed"], learned["seed"]), (3, 3))
        self.has(learned["learning"], "moves", "log_posterior_trace", "rounds", "expected_wrong_links")
        self.has(self.one_json_object("particles", "info", model), "width", "height", "templates")
        self.has(self.one_json_object("particles", "tracks", model, "-o", self.folder / "t.csv"), "tracks", "points")
        self.has(self.one_json_object("particles", "explain", model, video), "models", "image")
        self.has(self.one_json_object("particles", "maps", model, "-o", self.folder / "m"), "births", "deaths")
        self.has(self.one_json_object("particles", "compress", video, "-o", small), "bytes", "raw_bytes", "psnr", "ratio")
        self.has(self.one_json_object("particles", "decompress", small, "-o", self.folder / "b.mkv"), "frames")
        self.has(self.one_json_object("particles", "decompose", video, "-o", self.folder / "d", "--counts", 5), "frames")

    def test_segment(self):
        self.one_json_object("motion", "segment", self.model(), CLIPS[0])

    def test_score(self):
        value = self.one_json_object("motion", "score", self.model(), CLIPS[0])
        self.has(value, "log_likelihood_per_frame", "global_lds_log_likelihood_per_frame")

    def test_compare(self):
        value = self.one_json_object("motion", "compare", "--reference", CLIPS[0], "--generated", CLIPS[1])
        self.has(value, "coverage", "global_diversity", "local_diversity", "jerk_ratio", "contact_speed_ratio",
                 "pose_jump_ratio", "speed_ratio")

    def test_compare_with_itself(self):
        value = self.one_json_object("motion", "compare", "--reference", CLIPS[0], "--generated", CLIPS[0])
        for key in ("jerk_ratio", "contact_speed_ratio", "pose_jump_ratio", "speed_ratio"):
            self.assertAlmostEqual(value[key], 1, places=6)
        self.assertAlmostEqual(value["global_diversity"], 0, places=6)


if __name__ == "__main__":
    unittest.main()
