# SPDX-FileCopyrightText: 2026 The motex authors
# SPDX-License-Identifier: MIT
"""What the tests of the command share: running it, the bundled clips, a model learned from them."""

import functools
import json
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

MOTEX = os.environ["MOTEX"]
DATA = Path(__file__).resolve().parent.parent / "data" / "mocap"
CLIPS = [str(path) for path in sorted((DATA / "quickstart").glob("*.bvh"))]
SYNTHETIC = DATA / "synthetic"


def run(*arguments, binary=MOTEX, **options):
    """The finished process of `motex ARGUMENTS`, its output as text."""
    words = [binary, *map(str, arguments)]
    options = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "stdin": subprocess.DEVNULL, **options}
    return subprocess.run(words, text=True, timeout=500, **options)


def write_cut(source, target, num_frames):
    """The first frames of a BVH file, its header put right."""
    head, rows = Path(source).read_text().split("MOTION")
    lines = rows.strip().splitlines()
    kept = [f"Frames: {num_frames}", lines[1], *lines[2 : 2 + num_frames]]
    Path(target).write_text(head + "MOTION\n" + "\n".join(kept) + "\n")
    return str(target)


@functools.cache
def commands():
    """Every command of motex as words, from its own reference."""
    reference = run("help", "--reference").stdout
    return [line.removeprefix("## motex ").split() for line in reference.splitlines() if line.startswith("## motex ")]


@functools.cache
def model_bytes():
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "dance.motex"
        result = run("motion", "learn", *CLIPS, "-o", path)
        if result.returncode != 0:
            raise RuntimeError(f"learning the bundled clips failed: {result.stderr}")
        return path.read_bytes()


@functools.cache
def snow_bytes():
    """A model of textured motion, learned from simulated snow."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for words in [
            ("simulate", "snow", "-o", folder / "snow", "--frames", "16", "--elements", "12", "--width", "72", "--height",
             "54", "--noise", "2"),
            ("learn", folder / "snow" / "scene.mkv", "-o", folder / "snow.motex", "--rounds", "0"),
        ]:
            result = run("particles", *words)
            if result.returncode != 0:
                raise RuntimeError(f"{words}: {result.stderr}")
        return (folder / "snow.motex").read_bytes()


class CommandTest(unittest.TestCase):
    """Every test works in an empty folder of its own."""

    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)

    def model(self):
        path = self.folder / "dance.motex"
        path.write_bytes(model_bytes())
        return path

    def snow_model(self):
        path = self.folder / "snow.motex"
        path.write_bytes(snow_bytes())
        return path

    def files(self):
        return sorted(path.name for path in self.folder.iterdir())

    def succeed(self, *arguments, **options):
        result = run(*arguments, **options)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result

    def fail_with(self, code, *arguments, saying=".", **options):
        """Runs, and checks what every failure must keep: exit code, stdout empty, a short message, no new file."""
        before = self.files()
        result = run(*arguments, **options)
        self.assertEqual(result.returncode, code, f"{arguments}: {result.stderr}")
        self.assertFalse(result.stdout, "a failure prints nothing on stdout")
        lines = result.stderr.splitlines()
        self.assertTrue(1 <= len(lines) <= 3, result.stderr)
        self.assertRegex(lines[-1], saying)
        self.assertEqual(self.files(), before, "a failure leaves nothing behind")
        return result

    def one_json_object(self, *arguments):
        result = self.succeed(*arguments, "--json")
        value = json.loads(result.stdout)
        self.assertIsInstance(value, dict)
        return value
