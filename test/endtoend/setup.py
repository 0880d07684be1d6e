# SPDX-FileCopyrightText: 2026 the semslam authors
# SPDX-License-Identifier: BSD-3-Clause
"""Renders the clip that the end-to-end tests use."""
import shutil
import sys

import harness

shutil.rmtree(harness.WORK, ignore_errors=True)
harness.WORK.mkdir(parents=True)
RESULT = harness.run("render_clip", "desk", harness.CLIP, "--frames", harness.NUM_FRAMES)
sys.stderr.write(RESULT.stderr)
sys.exit(RESULT.returncode)
