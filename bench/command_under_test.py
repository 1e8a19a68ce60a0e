# SPDX-FileCopyrightText: 2026 The motex authors
# SPDX-License-Identifier: MIT
"""What the benchmarks of commands measure, and on which data (as bench/motion_data.h)."""

import os
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
MOTEX = os.environ.get("MOTEX", str(ROOT / "build/release/motex"))


def data_folder():
    named = (sys.argv[1:] or [os.environ.get("MOTEX_BENCH_DATA", "")])[0]
    if named:
        return Path(named)
    shared = ROOT.parent / "shared/data/mocap"
    return shared if shared.is_dir() else ROOT / "tests/data/mocap"
