# SPDX-FileCopyrightText: 2026 The motex authors
# SPDX-License-Identifier: MIT
"""Bad input: one clear message, the right exit code, nothing half-written, nothing lost."""

import os
import resource
import signal
import subprocess
import time
import unittest

from command import CLIPS, MOTEX, SYNTHETIC, CommandTest, run, write_cut


class BadClips(CommandTest):
    def learn_fails(self, *clips, saying):
        self.fail_with(2, "motion", "learn", *clips, "-o", self.folder / "x.motex", saying=saying)

    def test_too_short(self):
        self.learn_fails(write_cut(CLIPS[0], self.folder / "short.bvh", 72), saying="short")

    def test_one_frame(self):
        self.learn_fails(write_cut(CLIPS[0], self.folder / "one.bvh", 1), saying="one.bvh|short|frame")

    def test_zero_frames(self):
        self.learn_fails(SYNTHETIC / "zero_frames.bvh", saying="frame")

    def test_different_skeletons_names_the_first_joint(self):
        self.learn_fails(CLIPS[0], SYNTHETIC / "ok_reference.bvh", saying="joint")

    def test_not_a_number_says_the_line(self):
        self.learn_fails(SYNTHETIC / "nan_and_inf_values.bvh", saying=r"nan_and_inf_values\.bvh:\d+: ")

    def test_broken_text_says_the_line(self):
        self.learn_fails(SYNTHETIC / "missing_closing_brace.bvh", saying=r"missing_closing_brace\.bvh:\d+: ")

    def test_missing_file(self):
        self.learn_fails(self.folder / "none.bvh", saying=r"none\.bvh")

    def test_folder_instead_of_file(self):
        self.learn_fails(self.folder, saying=self.folder.name)

    def test_unknown_kind_of_file(self):
        (self.folder / "clip.xyz").write_text("hello")
        self.learn_fails(self.folder / "clip.xyz", saying=r"xyz")


class BadModels(CommandTest):
    def test_truncated(self):
        model = self.model()
        whole = model.read_bytes()
        for size in [0, 1, 7, 8, 9, 20, 100, len(whole) // 2, len(whole) - 4, len(whole) - 1]:
            model.write_bytes(whole[:size])
            self.fail_with(2, "motion", "info", model, saying=r"dance\.motex")

    def test_altered(self):
        model = self.model()
        whole = model.read_bytes()
        for place in [0, 8, 12, 14, 40, len(whole) // 3, len(whole) // 2, len(whole) - 1]:
            model.write_bytes(whole[:place] + bytes([whole[place] ^ 0x41]) + whole[place + 1 :])
            self.fail_with(2, "motion", "info", model, saying=r"dance\.motex")

    def test_foreign(self):
        model = self.folder / "dance.motex"
        for text in [b"HIERARCHY\nROOT hips\n", b"\x89PNG\r\n\x1a\n" + bytes(100), bytes(4096)]:
            model.write_bytes(text)
            out = self.folder / "x.bvh"
            self.fail_with(2, "motion", "synthesize", model, "-o", out, "--secs", 1, saying=r"dance\.motex")

    def test_clip_instead_of_model(self):
        self.fail_with(2, "motion", "path", CLIPS[0], "--from", 0, "--to", 1, saying="salsa")

    def test_path_through_a_texton_that_does_not_exist(self):
        out = self.folder / "x.bvh"
        self.fail_with(2, "motion", "synthesize", self.model(), "-o", out, "--path", "0,99999", saying="99999")


    def test_textons_stretched_varied_and_edited(self):
        model, out = self.model(), self.folder / "x.bvh"
        for words, saying in [
            (("stretch", "--texton", 99999, "--frames", 100), "99999"),
            (("stretch", "--texton", 0, "--frames", 3), "4 frames"),
            (("stretch", "--texton", 0, "--frames", 10**9), "50 times"),
            (("stretch", "--frames", 100), "--texton"),
            (("stretch", "--texton", 0, "--example", "a@3", "--frames", 100), "--texton"),
            (("vary", "--example", "none@3"), "none"),
            (("vary", "--example", "none"), "CLIP@FRAME"),
            (("vary", "--texton", 0, "--noise", 0), "noise"),
            (("edit", "--texton", 0), "nothing to edit"),
            (("edit", "--texton", 0, "--turn", "20:head=0,30"), "X,Y,Z"),
            (("edit", "--texton", 0, "--turn", "20head"), "JOINT"),
            (("edit", "--texton", 0, "--turn", "20:haed=0,30,0"), "did you mean 'head'"),
            (("edit", "--texton", 0, "--turn", "1:head=0,30,0"), "frame 1 cannot be edited"),
            (("edit", "--texton", 0, "--set", "20:head=nan,0,0"), "head|finite|number"),
            (("edit", "--texton", 0, "--turn", "20:head=0,9,0", "--set", "20:head=0,9,0"), "twice"),
            (("edit", "--texton", 0, "--pose", "20=none.bvh@3"), "none"),
        ]:
            self.fail_with(2, "motion", words[0], model, *words[1:], "-o", out, saying=saying)
            self.assertFalse(out.exists())


class BadParticles(CommandTest):
    """Every command of particles that takes a model, a video or a compressed clip."""

    def of_model(self, model):
        out = self.folder / "out"
        return [
            ("info", model),
            ("tracks", model, "-o", f"{out}.csv"),
            ("synthesize", model, "-o", f"{out}.mkv", "--frames", 3),
            ("maps", model, "-o", out),
            ("explain", model, self.folder / "any.mkv"),
            ("compress", self.folder / "any.mkv", "-o", f"{out}.mtxc", "--model", model),
        ]

    def test_models(self):
        good = self.snow_model()
        self.succeed("particles", "synthesize", good, "-o", self.folder / "any.mkv", "--frames", 4)
        whole = good.read_bytes()
        bad = self.folder / "bad.motex"
        altered = bytearray(whole)
        altered[len(whole) // 2] ^= 0x41
        dance = self.model().read_bytes()
        for contents in [b"", whole[:9], whole[: len(whole) // 2], whole[:-1], bytes(altered), b"hello\n", bytes(4096), dance]:
            bad.write_bytes(contents)
            for words in self.of_model(bad):
                self.fail_with(2, "particles", *words, saying=r"bad\.motex")
        for words in self.of_model(self.folder / "none.motex"):
            self.fail_with(2, "particles", *words, saying=r"none\.motex")
        for words in [("info", good), ("synthesize", good, "-o", self.folder / "x.bvh", "--secs", 1)]:
            self.fail_with(2, "motion", *words, saying=r"snow\.motex")

    def test_videos(self):
        model, out = self.snow_model(), self.folder / "out"
        self.succeed("particles", "synthesize", model, "-o", self.folder / "good.mkv", "--frames", 4)
        whole = (self.folder / "good.mkv").read_bytes()
        bad = self.folder / "bad.mp4"
        pointer = b"version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 1\n"
        for contents, saying in [
            (b"", "empty"), (b"no video\n", "text file"), (pointer, "git lfs pull"), (bytes(4096), r"bad\.mp4"),
            (whole[:300], r"bad\.mp4"), (None, r"bad\.mp4"),
        ]:
            if contents is None:
                bad.unlink()
            else:
                bad.write_bytes(contents)
            for words in [
                ("learn", bad, "-o", f"{out}.motex"),
                ("decompose", bad, "-o", out),
                ("explain", model, bad),
                ("compress", bad, "-o", f"{out}.mtxc"),
                ("tracks", model, "-o", f"{out}.mkv", "--video", bad),
            ]:
                self.fail_with(2, "particles", *words, saying=saying)
        self.fail_with(2, "particles", "decompress", self.folder / "good.mkv", "-o", f"{out}.mkv", saying=r"good\.mkv")

    def test_too_little_to_learn_from(self):
        model = self.snow_model()
        two, still = self.folder / "two.mkv", self.folder / "still.mkv"
        self.succeed("particles", "synthesize", model, "-o", two, "--frames", 2)
        self.succeed("particles", "synthesize", model, "-o", still, "--frames", 20, "--rate", 0)
        for video, saying in [(two, "frames"), (still, "nothing moves")]:
            self.fail_with(2, "particles", "learn", video, "-o", self.folder / "x.motex", saying=saying)
        target = self.folder / "x.motex"
        for flag, value, saying in [
            ("--rounds", -1, "rounds"), ("--sweeps", 0, "sweeps"), ("--tracking", "water", "tracking"), ("--seed", "x", "seed"),
            ("--first-frame", 99, "frame 99"), ("--num-frames", 1, "frames"), ("--background", "green", "background"),
        ]:
            self.fail_with(2, "particles", "learn", still, "-o", target, flag, value, saying=saying)

    def test_targets(self):
        model = self.snow_model()
        for words in [
            ("tracks", model), ("synthesize", model, "--frames", 3), ("maps", model),
            *(("simulate", kind, "--frames", 3, "--width", 32, "--height", 24) for kind in ("snow", "birds", "fireworks")),
        ]:
            self.fail_with(2, "particles", *words, "-o", self.folder / "none" / "x", saying="none")
            self.fail_with(2, "particles", *words, "-o", "/proc/x", saying="/proc|x")
        self.fail_with(2, "particles", "tracks", model, "-o", self.folder / "x.xyz", saying="xyz")


class BadPeople(CommandTest):
    """Every command of people that takes a model or a video."""

    def of_model(self, model):
        out = self.folder / "out"
        return [
            ("info", model),
            ("name", model, "A", "bow"),
            ("signals", model, "-o", f"{out}.csv"),
            ("motifs", model, "--picture", f"{out}.png"),
            ("direct", model, "--script", "A", "-o", f"{out}.mkv"),
            ("play", model, "--secs", 1, "-o", f"{out}.mkv"),
            ("crowd", model, "--secs", 1, "-o", f"{out}.mkv"),
            ("export", model, "-o", out),
        ]

    def of_video(self, video):
        out = self.folder / "out"
        return [
            ("key", video, "-o", f"{out}.mkv"),
            ("signals", video, "-o", f"{out}.csv"),
            ("motifs", video, "--picture", f"{out}.png"),
            ("motifs", video, "--paper"),
            ("learn", video, "-o", f"{out}.motex"),
        ]

    def test_models(self):
        snow = self.snow_model().read_bytes()
        bad = self.folder / "bad.motex"
        for contents in [b"", snow[:9], b"hello\n", bytes(4096), snow]:
            bad.write_bytes(contents)
            for words in self.of_model(bad):
                self.fail_with(2, "people", *words, saying=r"bad\.motex")
        for words in self.of_model(self.folder / "none.motex"):
            self.fail_with(2, "people", *words, saying=r"none\.motex")

    def test_videos(self):
        bad = self.folder / "bad.mp4"
        for contents, saying in [(b"", "empty"), (b"no video\n", "text file"), (bytes(4096), r"bad\.mp4"), (None, r"bad\.mp4")]:
            if contents is None:
                bad.unlink()
            else:
                bad.write_bytes(contents)
            for words in self.of_video(bad):
                self.fail_with(2, "people", *words, saying=saying)

    def test_footage_that_shows_nobody_or_too_little(self):
        empty, short = self.folder / "empty.mkv", self.folder / "short"
        self.succeed("particles", "synthesize", self.snow_model(), "-o", empty, "--frames", 20, "--rate", 0)
        self.succeed("people", "simulate", "-o", short, "--frames", 3, "--size", "96x64")
        for words in self.of_video(empty):
            self.fail_with(2, "people", *words, saying="nobody|person|frames")
        for words in self.of_video(short / "scene.mp4")[-2:]:
            self.fail_with(2, "people", *words, saying="3 frames|too short")

    def test_series(self):
        table = self.folder / "s.csv"
        table.write_text("aspect\n" + "".join(f"{k * k % 17}\n" for k in range(100)))
        for words, saying in [
            (("--window", 60), "60"),
            (("--window", 3), "window"),
            (("--paper", "--window", 60), r"s\.csv: too short for two windows of 60 frames"),
            (("--column", "area"), "no column 'area', only aspect"),
            (("--picture", self.folder / "p.bmp"), "bmp"),
            (("--profile", self.folder / "p.png"), "png"),
            (("--fps", 0), "fps"),
        ]:
            self.fail_with(2, "people", "motifs", table, *words, saying=saying)
        table.write_text("aspect\n1\ntwo\n")
        self.fail_with(2, "people", "motifs", table, saying=r"s\.csv:3: 'two' is no number")


class BadTargets(CommandTest):
    def synthesize_fails(self, code, target, *more, saying=".", **options):
        arguments = ("motion", "synthesize", self.model(), "-o", target, "--secs", 20, *more)
        return self.fail_with(code, *arguments, saying=saying, **options)

    def test_missing_folder(self):
        self.synthesize_fails(2, self.folder / "none" / "x.bvh", saying="none")

    def test_folder_that_takes_no_files(self):
        self.synthesize_fails(2, "/proc/x.bvh", saying="/proc")

    def test_unknown_format(self):
        self.synthesize_fails(2, self.folder / "x.xyz", saying="xyz")

    def test_target_is_known_bad_before_learning(self):
        self.fail_with(2, "motion", "learn", *CLIPS, "-o", self.folder / "none" / "x.motex", saying="none")

    def test_full_device(self):
        self.model()
        (self.folder / "x.bvh").symlink_to("/dev/full")
        self.synthesize_fails(1, self.folder / "x.bvh", "--force", saying="space|full|write")

    def test_file_that_may_not_grow_keeps_the_old_one(self):
        old = self.folder / "x.bvh"
        old.write_text("old")
        self.model()

        def limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (20_000, 20_000))
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)

        self.synthesize_fails(1, old, "--force", saying="large|write|space", preexec_fn=limit, restore_signals=False)
        self.assertEqual(old.read_text(), "old")

    def test_full_disk_keeps_the_old_file(self):
        disk = self.folder / "disk"
        disk.mkdir()
        mount = ["mount", "-t", "tmpfs", "-o", "size=64k", "none", str(disk)]
        if os.geteuid() != 0 or subprocess.run(mount, stderr=subprocess.DEVNULL, check=False).returncode != 0:
            self.skipTest("mounting a small disk needs root")
        self.addCleanup(subprocess.run, ["umount", str(disk)], check=True)
        old = disk / "x.bvh"
        old.write_text("old")
        self.model()
        self.synthesize_fails(1, old, "--force", saying="space|full")
        self.assertEqual([path.name for path in disk.iterdir()], ["x.bvh"])
        self.assertEqual(old.read_text(), "old")

    def test_stdout_full(self):
        with open("/dev/full", "w", encoding="utf-8") as full:
            result = run("motion", "info", self.model(), "--json", stdout=full)
        self.assertEqual(result.returncode, 1, result.stderr)


class BadChoreographies(CommandTest):
    def test_places_boxes_and_limbs(self):
        model, clip = self.model(), CLIPS[0].rsplit("/", 1)[1].removesuffix(".bvh")
        poses = ("--start", f"{clip}@10", "--end", f"{clip}@900", "--frames", 300, "--place", "0,0,0")
        for flag, value, saying in [
            ("--at", "0,0", r"N:X,Z\[,HEADING\]"),
            ("--at", "299:0", r"N:X,Z\[,HEADING\]"),
            ("--at", "299:0,nan", "nan|finite"),
            ("--at", "300:0,0", "frame 300"),
            ("--at", "0:0,0", "frame 0"),
            ("--avoid", "1,2,3", "X0,Z0,X1,Z1"),
            ("--avoid", "-1,-1,1,1", "start lies inside the box -1,-1,1,1"),
            ("--reach", "lHand:1,2,3", "JOINT@N:X,Y,Z"),
            ("--reach", "lHand@20:1,2", "JOINT@N:X,Y,Z"),
            ("--reach", "nose@20:1,2,3", "no joint 'nose'"),
            ("--reach", "hip@20:1,2,3", "'hip' has no limb"),
            ("--reach", "lHand@400:1,2,3", "400"),
            ("--reach", "lHand@299:1,2,3", "pose of this frame is given"),
            ("--body-radius", "-1", "body-radius"),
        ]:
            out = self.folder / "x.bvh"
            self.fail_with(2, "motion", "choreograph", model, *poses, "-o", out, flag, value, saying=saying)
            self.assertFalse(out.exists())


class Interrupted(CommandTest):
    def setUp(self):
        super().setUp()
        # A background job inherits "ignore Ctrl-C", which motex obeys; a handled signal is passed on as the default.
        signal.signal(signal.SIGINT, signal.default_int_handler)

    def interrupt(self, *arguments):
        """Sends Ctrl-C while the command works; gives up waiting for the right moment after some tries."""
        before = self.files()
        for pause in (0.5, 0.25, 0.1, 0.05):
            with subprocess.Popen([MOTEX, *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
                time.sleep(pause)
                process.send_signal(signal.SIGINT)
                out, err = process.communicate(timeout=60)
            if process.returncode != 0:
                break
        self.assertEqual(process.returncode, 130, err)
        self.assertEqual(out, b"")
        self.assertLessEqual(len(err.splitlines()), 3)
        self.assertEqual(self.files(), before)

    def test_learning_leaves_the_old_model(self):
        model = self.model()
        before = model.read_bytes()
        self.interrupt("motion", "learn", *(CLIPS * 40), "-o", model, "--force")
        self.assertEqual(model.read_bytes(), before)

    def test_learning_particles_leaves_nothing(self):
        scene = self.folder / "scene"
        self.succeed("particles", "simulate", "snow", "-o", scene, "--frames", 60, "--elements", 150)
        self.interrupt("particles", "learn", scene / "scene.mkv", "-o", self.folder / "x.motex", "--sweeps", 1000)

    def test_synthesizing_particles_leaves_nothing(self):
        self.interrupt("particles", "synthesize", self.snow_model(), "-o", self.folder / "x.mkv", "--frames", 1000000)

    def test_synthesizing_leaves_nothing(self):
        self.interrupt("motion", "synthesize", self.model(), "-o", self.folder / "x.bvh", "--secs", 36000)


if __name__ == "__main__":
    unittest.main()
