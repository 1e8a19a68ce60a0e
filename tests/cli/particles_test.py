# SPDX-FileCopyrightText: 2026 The motex authors
# SPDX-License-Identifier: MIT
"""The commands of the noun particles: what they write, and how they take bad requests."""

import json
import math
import unittest
from xml.etree import ElementTree

from command import CommandTest


def write_pictures(folder, num_frames=9, width=48, height=36):
    """Grey pictures: a bright blob that falls through a gradient."""
    folder.mkdir()
    for t in range(num_frames):
        rows = bytearray()
        for y in range(height):
            for x in range(width):
                blob = 120 * math.exp(-((x - 20) ** 2 + (y - 4 * t) ** 2) / 8)
                rows.append(min(255, round(40 + x + blob)))
        (folder / f"f_{t:03}.pgm").write_bytes(b"P5\n%d %d\n255\n" % (width, height) + rows)
    return folder


class Decompose(CommandTest):
    def setUp(self):
        super().setUp()
        self.video = write_pictures(self.folder / "video")
        self.target = self.folder / "out"

    def decompose(self, *arguments):
        return self.one_json_object("particles", "decompose", self.video, "-o", self.target, *arguments)

    def test_one_frame(self):
        report = self.decompose("--counts", "5,20", "--min-coefficient", "0")
        (frame,) = report["frames"]
        self.assertEqual(frame["frame"], 4, "the middle one")
        self.assertEqual(frame["background"], "median")
        few, many = (stage["psnr"] for stage in frame["stages"])
        self.assertGreater(few, frame["background_psnr"] + 10)
        self.assertGreater(many, few)
        self.assertEqual(json.loads((self.target / "decomposition.json").read_text())["frames"], report["frames"])
        lines = (self.target / "bases_0005.csv").read_text().splitlines()
        self.assertEqual(lines[0], "frame,idx,kind,x,y,scale,angle,coefficient")
        self.assertEqual(lines[1].split(",")[2], "gaussian")
        self.assertAlmostEqual(float(lines[1].split(",")[3]), 20, delta=0.2)
        self.assertAlmostEqual(float(lines[1].split(",")[4]), 16, delta=0.2)
        self.assertAlmostEqual(float(lines[1].split(",")[5]), 2, delta=0.2)
        for name in ["observed", "background", "reconstruction_0020", "sketch_0020", "figure"]:
            self.assertTrue((self.target / f"{name}.png").read_bytes().startswith(b"\x89PNG"))

    def test_all_frames(self):
        report = self.decompose("--all", "--counts", "10")
        self.assertEqual([frame["frame"] for frame in report["frames"]], list(range(9)))
        self.assertEqual((self.target / "bases.csv").read_text().splitlines()[-1].split(",")[0], "8")
        self.assertGreater((self.target / "reconstruction_0010.mp4").stat().st_size, 500)
        again = self.folder / "again"
        self.succeed("particles", "decompose", self.video, "-o", again, "--all", "--counts", "10", "--jobs", "1")
        for name in ["bases.csv", "reconstruction_0010.mp4", "sketch_0010.mp4"]:
            self.assertEqual((self.target / name).read_bytes(), (again / name).read_bytes(), name)

    def test_a_frame_and_the_papers_way(self):
        report = self.decompose("--frame", "0", "--dictionary", "paper", "--background", "flat", "--counts", "30")
        self.assertEqual(report["frames"][0]["frame"], 0)
        self.assertNotIn("gaussian", (self.target / "bases_0030.csv").read_text())

    def test_nothing_is_overwritten_without_force(self):
        self.target.mkdir()
        (self.target / "observed.png").write_text("old")
        arguments = ("particles", "decompose", self.video, "-o", self.target, "--counts", "5")
        self.fail_with(2, *arguments, saying="--force")
        self.assertEqual((self.target / "observed.png").read_text(), "old")
        self.succeed(*arguments, "--force")
        self.assertNotEqual((self.target / "observed.png").read_bytes(), b"old")
        self.assertEqual(self.files(), ["out", "video"])

    def test_dry_run_and_quiet(self):
        self.succeed("particles", "decompose", self.video, "-o", self.target, "--dry-run")
        self.assertFalse(self.target.exists())
        result = self.succeed("particles", "decompose", self.video, "-o", self.target, "--counts", "5", "--quiet")
        self.assertEqual(result.stderr, "")

    def test_bad_requests(self):
        text, pointer, empty = (self.folder / name for name in ("text.mp4", "pointer.mp4", "empty.mp4"))
        text.write_text("no video\n")
        pointer.write_text("version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 1\n")
        empty.write_bytes(b"")
        for video, arguments, saying in [
            (text, [], "text file"),
            (pointer, [], "git lfs pull"),
            (empty, [], "empty"),
            (self.folder / "missing.mp4", [], "cannot be read"),
            (self.folder / "f_%03d.png", [], "no file fits"),
            (self.video, ["--frame", "9"], "no frame 9"),
            (self.video, ["--frame", "1", "--all"], "exclude"),
            (self.video, ["--counts", "0"], "counts"),
            (self.video, ["--counts", "x"], "counts"),
            (self.video, ["--refine-steps", "-1"], "refine"),
            (self.video, ["--background", "green"], "background"),
        ]:
            self.fail_with(2, "particles", "decompose", video, "-o", self.target, *arguments, saying=saying)
        self.fail_with(2, "particles", "decompose", self.video, "-o", self.folder / "no" / "such", saying="no folder")


class Score(CommandTest):
    def write(self, name, rows, heading="frame,id,x,y,amp"):
        path = self.folder / name
        path.write_text("\n".join([heading, *rows]) + "\n")
        return path

    def test_score(self):
        truth = self.write("truth.csv", [f"{t},1,{t},5,100" for t in range(10)] + ["10,1,10,5,0", "11,1,99,5,100"])
        tracks = self.write("tracks.csv", [f"{t},7,{t},8" for t in range(10)], "frame,track,x,y")
        score = self.one_json_object("particles", "score", "--truth", truth, "--tracks", tracks, "--size", "20x20")
        self.assertAlmostEqual(score["alpha"], 0.4)
        self.assertAlmostEqual(score["beta"], 0.4)
        self.assertAlmostEqual(score["rmse"], 3)
        self.assertEqual(score["jsc_tracks"], 1)
        perfect = self.one_json_object("particles", "score", "--truth", truth, "--tracks", truth)
        self.assertEqual(perfect["beta"], 1)

    def test_bad_requests(self):
        good = self.write("good.csv", ["0,1,2,3,4"])
        for rows, heading, saying in [
            ([], "frame,x,y", "good|bad.csv:1"),
            (["0,1,oops,3,4"], "frame,id,x,y,amp", "bad.csv:2"),
            (["0,1,2,3,4", "0,1,2,3,4"], "frame,id,x,y,amp", "twice"),
        ]:
            bad = self.write("bad.csv", rows, heading)
            self.fail_with(2, "particles", "score", "--truth", good, "--tracks", bad, saying=saying)
        self.fail_with(2, "particles", "score", "--truth", good, "--tracks", good, "--gate", "0", saying="gate")
        self.fail_with(2, "particles", "score", "--truth", good, "--tracks", good, "--size", "9", saying="size")
        empty = self.write("empty.csv", [])
        self.fail_with(2, "particles", "score", "--truth", empty, "--tracks", good, saying="no visible point")


def write_snow(folder, num_frames=12, width=64, height=48):
    """Grey pictures: six bright blobs that fall at their own speeds."""
    folder.mkdir()
    for t in range(num_frames):
        rows = bytearray()
        for y in range(height):
            for x in range(width):
                light = 50 + (x * 7 + y * 13 + t * 5) % 5
                for k in range(6):
                    light += 130 * math.exp(-((x - 6 - 10 * k - 0.5 * t) ** 2 + (y + 4 - 6 * k % 17 - (2 + k % 2) * t) ** 2) / 5)
                rows.append(min(255, round(light)))
        (folder / f"f_{t:03}.pgm").write_bytes(b"P5\n%d %d\n255\n" % (width, height) + rows)
    return folder


class Tracks(CommandTest):
    """particles tracks, explain, compress: what is made of a model."""

    def setUp(self):
        super().setUp()
        self.video = write_snow(self.folder / "snow")
        self.model = self.folder / "snow.motex"
        self.succeed("particles", "learn", self.video, "-o", self.model, "--rounds", "0")

    def test_table_trackmate_and_overlay(self):
        table, xml, simple, video = (self.folder / name for name in ("t.csv", "t.xml", "t_Tracks.xml", "t.mkv"))
        outputs = [word for path in (table, xml, simple, video) for word in ("-o", path)]
        report = self.one_json_object("particles", "tracks", self.model, *outputs)
        lines = table.read_text().splitlines()
        self.assertEqual(lines[0], "track,frame,x,y,scale,angle,amplitude")
        self.assertEqual(len(lines) - 1, report["points"])
        self.assertGreaterEqual(report["tracks"], 5)
        for line in lines[1:]:
            track, frame, x, y, *_ = line.split(",")
            self.assertTrue(int(track) >= 0 and 0 <= int(frame) < 12)
            self.assertTrue(-0.5 <= float(x) < 63.5 and -0.5 <= float(y) < 47.5)
        root = ElementTree.parse(xml).getroot()
        self.assertEqual(root.tag, "TrackMate")
        self.assertEqual(len(root.findall(".//Spot")), report["points"])
        ids = {spot.get("ID") for spot in root.findall(".//Spot")}
        for edge in root.findall(".//Edge"):
            self.assertTrue({edge.get("SPOT_SOURCE_ID"), edge.get("SPOT_TARGET_ID")} <= ids)
        self.assertEqual(len(ElementTree.parse(simple).getroot().findall("particle")), report["tracks"])
        self.assertGreater(video.stat().st_size, 1000)
        over = self.folder / "over.mkv"
        self.succeed("particles", "tracks", self.model, "-o", over, "--video", self.video)
        self.assertNotEqual(over.read_bytes(), video.read_bytes())

    def test_trackmate_has_all_that_its_reader_asks_for(self):
        """The rules of TrackMate's own reader (fiji.plugin.trackmate.io.TmXmlReader): what it takes without a default, as
        which type, which elements it would stop at, which names it must find again elsewhere in the file."""
        path = self.folder / "t.xml"
        self.succeed("particles", "tracks", self.model, "-o", path)
        root = ElementTree.parse(path).getroot()
        whole, real = r"-?\d+", r"-?\d+(\.\d+)?([eE][-+]?\d+)?"

        def attributes(element, pattern, *names):
            for name in names:
                self.assertRegex(element.get(name) or "", f"^{pattern}$", f"{element.tag} {name}")

        def the(name, parent=root):
            (element,) = parent.findall(name)
            return element

        self.assertEqual(root.tag, "TrackMate")
        attributes(root, r"\d+\.\d+\.\d+", "version")
        attributes(the("GUIState"), "ConfigureViews", "state")
        model, settings = the("Model"), the("Settings")
        attributes(model, ".+", "spatialunits", "timeunits")

        dimensions = ("NONE|QUALITY|COST|INTENSITY|INTENSITY_SQUARED|POSITION|VELOCITY|LENGTH|AREA|VOLUME|TIME|ANGLE|RATE|"
                      "ANGLE_RATE|STRING")
        declared = {}
        for kind in ("SpotFeatures", "EdgeFeatures", "TrackFeatures"):
            for feature in the("FeatureDeclarations/" + kind, model).findall("Feature"):
                attributes(feature, ".+", "feature", "name", "shortname")
                attributes(feature, f"({dimensions})", "dimension")
                attributes(feature, "(true|false)", "isint")
                declared.setdefault(kind, {})[feature.get("feature")] = feature.get("isint") == "true"

        def features(element, kind, *others):
            for name, value in element.attrib.items():
                if name in others:
                    continue
                self.assertIn(name, declared[kind], element.tag)
                self.assertRegex(value, f"^{whole if declared[kind][name] else real}$", f"{element.tag} {name}")

        spots = {}
        for frame in the("AllSpots", model).findall("SpotsInFrame"):
            attributes(frame, whole, "frame")
            for spot in frame.findall("Spot"):
                attributes(spot, whole, "ID")
                attributes(spot, real, "QUALITY", "POSITION_X", "POSITION_Y", "POSITION_Z", "POSITION_T", "FRAME", "RADIUS",
                           "VISIBILITY")
                features(spot, "SpotFeatures", "ID", "name")
                self.assertEqual(spot.get("FRAME"), frame.get("frame"))
                self.assertNotIn(spot.get("ID"), spots)
                self.assertLess(int(spot.get("ID")), 2**31)
                spots[spot.get("ID")] = spot
        self.assertEqual(the("AllSpots", model).get("nspots"), str(len(spots)))

        tracks, edges = set(), set()
        for track in the("AllTracks", model).findall("Track"):
            attributes(track, whole, "TRACK_ID", "TRACK_INDEX")
            features(track, "TrackFeatures", "name")
            self.assertNotIn(track.get("TRACK_ID"), tracks)
            tracks.add(track.get("TRACK_ID"))
            self.assertTrue(track.findall("Edge"))
            for edge in track.findall("Edge"):
                features(edge, "EdgeFeatures")
                ends = (edge.get("SPOT_SOURCE_ID"), edge.get("SPOT_TARGET_ID"))
                self.assertTrue(set(ends) <= set(spots) and ends[0] != ends[1])
                self.assertLess(int(spots[ends[0]].get("FRAME")), int(spots[ends[1]].get("FRAME")))
                self.assertNotIn(frozenset(ends), edges)
                edges.add(frozenset(ends))
        self.assertTrue(tracks)
        shown = [one.get("TRACK_ID") for one in the("FilteredTracks", model).findall("TrackID")]
        self.assertEqual(set(shown), tracks)

        image = the("ImageData", settings)
        attributes(image, ".+", "filename", "folder")
        attributes(image, whole, "width", "height", "nslices", "nframes")
        attributes(image, real, "pixelwidth", "pixelheight", "voxeldepth", "timeinterval")
        crop = the("BasicSettings", settings)
        attributes(crop, whole, *(axis + end for axis in "xyzt" for end in ("start", "end")))
        attributes(the("DetectorSettings", settings), "MANUAL_DETECTOR", "DETECTOR_NAME")
        attributes(the("DetectorSettings", settings), real, "RADIUS")
        attributes(the("TrackerSettings", settings), "MANUAL_TRACKER", "TRACKER_NAME")
        first = the("InitialSpotFilter", settings)
        attributes(first, "QUALITY", "feature")
        attributes(first, real, "value")
        attributes(first, "(true|false)", "isabove")
        for name in ("SpotFilterCollection", "TrackFilterCollection"):
            self.assertEqual(len(the(name, settings)), 0)
        for name in ("SpotAnalyzers", "EdgeAnalyzers", "TrackAnalyzers"):
            the("AnalyzerCollection/" + name, settings)

    def test_units(self):
        plain, physical = self.folder / "a.csv", self.folder / "b.csv"
        self.succeed("particles", "tracks", self.model, "-o", plain)
        report = self.one_json_object("particles", "tracks", self.model, "-o", physical, "--pixel-size", "0.5", "--dt", "2")
        self.assertEqual((report["length_unit"], report["um_per_pixel"], report["secs_per_frame"]), ("um", 0.5, 2))
        first, second = (path.read_text().splitlines()[1].split(",") for path in (plain, physical))
        self.assertAlmostEqual(float(second[2]), float(first[2]) / 2, delta=1e-3)
        self.assertEqual(float(second[-1]), 2 * int(second[1]))

    def test_points_are_linked(self):
        points = self.folder / "points.csv"
        rows = [f"{t},{10 + 2 * t + 20 * k},{5 + t}" for t in range(15) for k in range(3)]
        points.write_text("frame,x,y\n" + "\n".join(rows) + "\n")
        out = self.folder / "linked.csv"
        report = self.one_json_object("particles", "tracks", "--detections", points, "-o", out, "--size", "100x80")
        self.assertEqual((report["tracks"], report["points"]), (3, 45))
        self.assertAlmostEqual(report["velocity"][0], 2, delta=0.2)

    def test_bad_requests_for_tracks(self):
        out, pictures = self.folder / "x.csv", self.folder / "x.mp4"
        bad = self.folder / "bad.csv"
        bad.write_text("frame,x\n1,2\n")
        for arguments, saying in [
            ((self.video, "-o", out), "particles learn"),
            (("-o", out), "MODEL"),
            ((self.model, "-o", self.folder / "x.xls"), "xls"),
            ((self.model, "-o", out, "--pixel-size", "-1"), "pixel-size"),
            ((self.model, "-o", out, "--dt", "nan"), "dt"),
            ((self.model, "-o", out, "--video", self.video), "overlay"),
            ((self.model, "-o", pictures, "--video", self.video, "--first-frame", "99"), "no frame 99"),
            (("--detections", bad, "-o", out), "bad.csv:1"),
            (("--detections", self.folder / "none.csv", "-o", out), "none.csv"),
            (("--detections", bad, "-o", pictures), "--video"),
            ((self.folder / "none.motex", "-o", out), "none.motex"),
        ]:
            self.fail_with(2, "particles", "tracks", *arguments, saying=saying)
        out.write_text("old")
        self.fail_with(2, "particles", "tracks", self.model, "-o", out, saying="--force")
        self.assertEqual(out.read_text(), "old")

    def test_maps(self):
        maps = self.folder / "maps"
        report = self.one_json_object("particles", "maps", self.model, "-o", maps)
        for name in ["source", "sink", "hazard", "occupancy", "maps"]:
            self.assertTrue((maps / f"{name}.png").read_bytes().startswith(b"\x89PNG"), name)
        births = (maps / "births.csv").read_text().splitlines()
        self.assertEqual(births[0], "track,frame,x,y,vx,vy")
        self.assertEqual(len(births) - 1, report["births"])
        self.assertEqual(json.loads((maps / "maps.json").read_text())["births_per_frame"], report["births_per_frame"])
        self.fail_with(2, "particles", "maps", self.model, "-o", maps, saying="--force")
        self.fail_with(2, "particles", "maps", self.video, "-o", self.folder / "m", saying="particles learn")
        self.fail_with(2, "particles", "maps", self.model, saying="-o")
        self.succeed("particles", "maps", self.model, "-o", self.folder / "m", "--dry-run")
        self.assertFalse((self.folder / "m").exists())

    def test_explain(self):
        odd, table = self.folder / "odd.png", self.folder / "odd.csv"
        value = self.one_json_object("particles", "explain", self.model, self.video, "--map", odd, "--tracks", table)
        (one,) = value["models"]
        self.assertEqual(one["probability"], 1)
        parts = sum(one[name] for name in ("births", "places", "looks", "motion", "deaths"))
        self.assertAlmostEqual(parts, one["log_likelihood"], places=6)
        self.assertGreater(value["image"]["psnr"], 20)
        self.assertTrue(odd.read_bytes().startswith(b"\x89PNG"))
        self.assertEqual(table.read_text().splitlines()[0], "track,frame,x,y,scale,angle,amplitude,surprise")
        for arguments, saying in [
            ((self.model,), "at least one model"),
            ((self.video, self.video), "particles learn"),
            ((self.model, self.folder / "none.mp4"), "none.mp4"),
            ((self.model, self.video, "--map", self.folder / "x.txt"), "txt"),
            ((self.model, self.video, "--tracks", table), "--force"),
        ]:
            self.fail_with(2, "particles", "explain", *arguments, saying=saying)

    def test_compress_and_decompress(self):
        small, back = self.folder / "snow.mtxc", self.folder / "back.mkv"
        report = self.one_json_object("particles", "compress", self.video, "-o", small, "--model", self.model, "--bases", "20")
        self.assertEqual(report["raw_bytes"], 64 * 48 * 12)
        self.assertEqual(report["bytes"], small.stat().st_size)
        self.assertGreater(report["psnr"], 33)
        self.assertGreater(report["ratio"], 20)
        self.assertEqual(self.one_json_object("particles", "decompress", small, "-o", back)["frames"], 12)
        whole = small.read_bytes()
        for size in (0, 5, 30, len(whole) // 2, len(whole) - 1):
            small.write_bytes(whole[:size])
            self.fail_with(2, "particles", "decompress", small, "-o", self.folder / "x.mkv", saying=r"snow\.mtxc")
        self.fail_with(2, "particles", "decompress", self.model, "-o", self.folder / "x.mkv", saying="compressed by motex")
        self.fail_with(2, "particles", "compress", self.video, "-o", self.folder / "x.zip", saying="mtxc")


def write_waterfall(folder, num_frames=40, width=48, height=40):
    """Grey pictures: a texture that falls by 2 pixels a frame, in streams of their own speed."""
    folder.mkdir()
    for t in range(num_frames):
        rows = bytearray()
        for y in range(height):
            for x in range(width):
                fall = y - (2 + x // 12 % 2) * t
                light = 110 + 30 * math.sin(0.9 * fall + 1.7 * x) + 25 * math.sin(0.41 * fall - 0.8 * x + 2)
                rows.append(min(255, max(0, round(light))))
        (folder / f"f_{t:03}.pgm").write_bytes(b"P5\n%d %d\n255\n" % (width, height) + rows)
    return folder


class Tracking(CommandTest):
    """particles learn --tracking: elements, or water."""

    def learn(self, video, *words):
        model = self.folder / "x.motex"
        return self.one_json_object("particles", "learn", video, "-o", model, "--force", *words), model

    def test_water_is_known_by_itself(self):
        video = write_waterfall(self.folder / "water")
        report, model = self.learn(video)
        self.assertEqual(report["options"]["tracking"], "auto")
        self.assertTrue(report["water"])
        self.assertEqual(report["templates"], 0)
        self.assertGreater(report["cables"], 200)
        self.assertTrue(self.one_json_object("particles", "info", model)["water"])
        self.fail_with(2, "particles", "maps", model, "-o", self.folder / "maps", saying="water")
        carried, _ = self.learn(video, "--tracking", "carry")
        self.assertEqual(carried["cables"], report["cables"])
        made = self.folder / "o.mkv"
        shown = self.one_json_object("particles", "synthesize", model, "-o", made, "--frames", 20)
        self.assertEqual(shown["frames"], 20)
        self.assertGreater(shown["bases_per_frame"], 50)
        for words in [("--rate", "2"), ("--gravity", "1"), ("--wind", "1,0"), ("--appearance", "templates"), ("--template", "0")]:
            self.fail_with(2, "particles", "synthesize", model, "-o", self.folder / "w.mkv", "--frames", "9", *words,
                           saying="water")

    def test_snow_is_elements_and_may_be_carried(self):
        video = write_snow(self.folder / "snow", 14)
        report, _ = self.learn(video, "--rounds", "0")
        self.assertFalse(report["water"])
        elements, _ = self.learn(video, "--rounds", "0", "--tracking", "cores")
        self.assertEqual(report["cables"], elements["cables"])
        carried, model = self.learn(video, "--tracking", "carry")
        self.assertEqual(carried["templates"], 0)
        self.fail_with(2, "particles", "synthesize", model, "-o", self.folder / "w.mkv", "--frames", "9", "--rate", "2",
                       saying="water")
        short = write_snow(self.folder / "short", 8)
        self.fail_with(2, "particles", "learn", short, "-o", self.folder / "y.motex", "--tracking", "carry", saying="12 frames")


class Simulate(CommandTest):
    def setUp(self):
        super().setUp()
        self.target = self.folder / "scene"
        self.small = ("--width", "64", "--height", "48", "--frames", "20", "--elements", "12")

    def rows(self, folder):
        lines = (folder / "tracks.csv").read_text().splitlines()
        self.assertEqual(lines[0], "track,frame,x,y,scale,angle,amplitude,state")
        return [[float(word) for word in line.split(",")] for line in lines[1:]]

    def test_snow(self):
        report = self.one_json_object("particles", "simulate", "snow", "-o", self.target, *self.small, "--wind", "-1")
        truth = json.loads((self.target / "truth.json").read_text())
        self.assertEqual(report["truth"]["mean_velocity"], [-1, 3])
        self.assertEqual(truth["options"]["seed"], report["seed"])
        rows = self.rows(self.target)
        self.assertEqual(truth["points"], len(rows))
        for row in rows:
            self.assertTrue(-0.5 <= row[2] < 63.5 and -0.5 <= row[3] < 47.5 and 0 <= row[1] < 20, row)
        self.assertTrue((self.target / "background.png").read_bytes().startswith(b"\x89PNG"))
        again = self.folder / "again"
        self.succeed("particles", "simulate", "snow", "-o", again, *self.small, "--wind", "-1", "--jobs", "1")
        for name in ["scene.mkv", "tracks.csv", "truth.json"]:
            self.assertEqual((self.target / name).read_bytes(), (again / name).read_bytes(), name)
        score = self.one_json_object("particles", "score", "--truth", again / "tracks.csv", "--tracks", again / "tracks.csv")
        self.assertEqual(score["beta"], 1)

    def test_birds_and_fireworks(self):
        self.succeed("particles", "simulate", "birds", "-o", self.target, *self.small)
        truth = json.loads((self.target / "truth.json").read_text())
        for row in truth["wing_transitions"]:
            self.assertAlmostEqual(sum(row), 1)
        self.assertLessEqual({row[7] for row in self.rows(self.target)}, {0, 1, 2})
        show = self.folder / "show"
        self.succeed("particles", "simulate", "fireworks", "-o", show, *self.small, "--bursts", "2")
        bursts = json.loads((show / "truth.json").read_text())["bursts"]
        self.assertEqual(len(bursts), 2)
        self.assertEqual(bursts[1]["first_track"], bursts[0]["sparks"])

    def test_bad_requests_write_nothing(self):
        for arguments, saying in [
            (("snow", "-o", self.target, "--persistence", "1"), "persistence"),
            (("snow", "-o", self.target, "--min-size", "9"), "min_size"),
            (("birds", "-o", self.target, "--frames", "0"), "frames"),
            (("fireworks",), "-o"),
            (("rain", "-o", self.target), "rain"),
            (("snow", "-o", self.folder / "no" / "such"), "no folder"),
        ]:
            self.fail_with(2, "particles", "simulate", *arguments, saying=saying)
        self.succeed("particles", "simulate", "snow", "-o", self.target, *self.small, "--dry-run")
        self.assertEqual(self.files(), [])
        self.target.mkdir()
        (self.target / "tracks.csv").write_text("old")
        self.fail_with(2, "particles", "simulate", "snow", "-o", self.target, *self.small, saying="--force")
        self.assertEqual((self.target / "tracks.csv").read_text(), "old")


if __name__ == "__main__":
    unittest.main()
