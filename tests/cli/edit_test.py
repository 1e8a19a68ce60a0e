# SPDX-FileCopyrightText: 2026 The motex authors
# SPDX-License-Identifier: MIT
"""Editing a model: what an edit does to dances, that it can be undone to the byte, and mixing."""

import unittest

from command import CLIPS, CommandTest


class Edits(CommandTest):
    def textons(self, model):
        return self.one_json_object("motion", "texton", "list", model)["textons"]

    def fork(self, model):
        """A texton that others follow, and the likeliest of them, two of which are danced."""
        for row in self.textons(model):
            others = [n["texton"] for n in row["next"] if n["texton"] != row["texton"]]
            if row["in_endless_dance"] and len(others) > 1:
                return row["texton"], others[0]
        self.fail("no texton has two followers")

    def test_every_edit_is_undone_to_the_byte(self):
        model = self.model()
        learned = model.read_bytes()
        a, b = self.fork(model)
        for edit in [("name", model, a, "turn"), ("drop", model, b), ("keep", model, a, b), ("merge", model, a, b),
                     ("weight", model, "--from", a, "--to", b, "--factor", 10), ("weight", model, "--to", b, "--factor", 2)]:
            self.succeed("motion", "texton", *edit)
            self.assertNotEqual(model.read_bytes(), learned)
            self.succeed("motion", "info", model)
            self.succeed("motion", "texton", "undo", model)
            self.assertEqual(model.read_bytes(), learned, edit)
        self.fail_with(2, "motion", "texton", "undo", model, saying="no edit")

    def test_o_leaves_the_model_alone(self):
        model, other = self.model(), self.folder / "other.motex"
        learned = model.read_bytes()
        self.succeed("motion", "texton", "name", model, 0, "start", "-o", other)
        self.assertEqual(model.read_bytes(), learned)
        self.fail_with(2, "motion", "texton", "name", model, 0, "begin", "-o", other, saying="--force")
        self.succeed("motion", "texton", "name", model, 0, "begin", "--dry-run")
        self.assertEqual(model.read_bytes(), learned)

    def test_names_stand_for_numbers(self):
        model = self.model()
        a, b = self.fork(model)
        self.succeed("motion", "texton", "name", model, a, "turn")
        self.assertEqual(self.one_json_object("motion", "path", model, "--from", "turn", "--to", b),
                         self.one_json_object("motion", "path", model, "--from", a, "--to", b))
        value = self.one_json_object("motion", "synthesize", model, "-o", self.folder / "x.bvh", "--path", f"turn,{b}")
        self.assertEqual(value["path"], [a, b])
        self.fail_with(2, "motion", "path", model, "--from", "trun", "--to", b, saying="did you mean 'turn'")
        self.assertEqual(self.textons(model)[a]["name"], "turn")

    def test_dropped_textons_are_not_danced(self):
        model = self.model()
        gone = [row["texton"] for row in self.textons(model) if row["in_endless_dance"]][:2]
        dance = ("motion", "synthesize", model, "-o", self.folder / "x.npz", "--secs", 60, "--force")
        before = self.one_json_object(*dance)
        self.succeed("motion", "texton", "drop", model, *gone)
        after = self.one_json_object(*dance)
        self.assertFalse(set(gone) & set(after["path"]))
        self.assertNotEqual(before["path"], after["path"])
        self.fail_with(2, *dance[:-3], "--path", gone[0], "--force", saying="dropped")
        self.fail_with(2, "motion", "path", model, "--from", gone[0], "--to", gone[1], saying="dropped")
        self.assertTrue(self.textons(model)[gone[0]]["dropped"])

    def test_a_forbidden_step_is_not_danced(self):
        model = self.model()
        a, b = self.fork(model)
        self.succeed("motion", "texton", "weight", model, "--from", a, "--to", b, "--factor", 0)
        path = self.one_json_object("motion", "synthesize", model, "-o", self.folder / "x.npz", "--secs", 120)["path"]
        self.assertNotIn((a, b), set(zip(path, path[1:])))

    def test_bad_edits(self):
        model = self.model()
        learned = model.read_bytes()
        texton = ("motion", "texton")
        last = len(self.textons(model))
        self.fail_with(2, *texton, saying="what")
        self.fail_with(2, *texton, "lst", model, saying="did you mean 'list'")
        self.fail_with(2, *texton, "drop", model, last, saying=f"no texton {last}")
        self.fail_with(2, *texton, "drop", model, *range(last), saying="left")
        self.fail_with(2, *texton, "merge", model, 1, 1, saying="itself")
        self.fail_with(2, *texton, "merge", model, 1, saying="two")
        self.fail_with(2, *texton, "name", model, 0, "7", saying="letter")
        self.fail_with(2, *texton, "name", model, 0, "a,b", saying="comma")
        self.fail_with(2, *texton, "weight", model, "--to", 1, "--factor", "-1", saying="factor")
        self.fail_with(2, *texton, "weight", model, "--to", 1, saying="--factor")
        self.fail_with(2, *texton, "undo", model, "--edit", 3, saying="no edit")
        self.fail_with(2, *texton, "drop", CLIPS[0], 0, saying="salsa|model")
        self.assertEqual(model.read_bytes(), learned)


class Mix(CommandTest):
    def test_a_mixed_dance_visits_both(self):
        paths = []
        for k, clip in enumerate(CLIPS[:2]):
            paths.append(self.folder / f"{k}.motex")
            self.succeed("motion", "learn", clip, "-o", paths[k])
        mixed = self.folder / "mixed.motex"
        report = self.one_json_object("motion", "mix", *paths, "-o", mixed)
        value = self.one_json_object("motion", "synthesize", mixed, "-o", self.folder / "x.npz", "--secs", 120)
        first = report["textons_of_b"][0]
        of_a = sum(i["length"] for i in value["instances"] if i["texton"] < first) / value["frames"]
        self.assertTrue(0.1 < of_a < 0.9, of_a)
        self.fail_with(2, "motion", "mix", *paths, "-o", mixed, saying="--force")
        self.fail_with(2, "motion", "mix", paths[0], CLIPS[0], "-o", self.folder / "y.motex", saying="model")


if __name__ == "__main__":
    unittest.main()
