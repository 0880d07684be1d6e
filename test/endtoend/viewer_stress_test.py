#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the semslam authors
# SPDX-License-Identifier: BSD-3-Clause
"""Runs in a window that is closed, and runs that are interrupted, at any time and at the same time.

By hand, here with a build that has sanitizers (targets rgbd_tum and render_clip of preset asan):
    test/endtoend/viewer_stress_test.py --build build/asan --runs 20 [--seed 1]
"""
import argparse
import itertools
import os
import pathlib
import random
import shutil
import signal
import sys
import tempfile
import time
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]


def read_arguments():
    """CTest gives none of them, but the harness's environment."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", type=pathlib.Path, help="folder of the build to be tested")
    parser.add_argument("--runs", type=int, default=5, help="default: 5")
    parser.add_argument("--seed", type=int, default=1, help="of the random times; default: 1")
    arguments = parser.parse_args()
    if arguments.build:
        os.environ["SEMSLAM_BIN"] = str(arguments.build.resolve() / "bin")
        os.environ["SEMSLAM_SOURCE"] = str(ROOT)
        os.environ["SEMSLAM_ENDTOEND"] = tempfile.mkdtemp(prefix="semslam_stress_")
    return arguments


ARGUMENTS = read_arguments()
import harness  # pylint: disable=wrong-import-position
import terminal  # pylint: disable=wrong-import-position
import xserver  # pylint: disable=wrong-import-position

LIMIT = 240  # Seconds, of one run under sanitizers.
# When something happens: as the window appears, at any time, after the last frame, when the files
# are written and the summary is told; and what: the window is closed, Ctrl-C, or both in any order.
BEGIN, ANY, LAST_FRAME, SUMMARY = "begin", "any time", "last frame", "summary"
CLOSE, INTERRUPT = "close", "interrupt"
CASES = [(ANY, [CLOSE]), (LAST_FRAME, [CLOSE, INTERRUPT]), (SUMMARY, [INTERRUPT, CLOSE]),
         (BEGIN, [CLOSE, INTERRUPT]), (ANY, [INTERRUPT, CLOSE]), (LAST_FRAME, [INTERRUPT, CLOSE]),
         (SUMMARY, [CLOSE]), (BEGIN, [INTERRUPT]), (ANY, [INTERRUPT]), (LAST_FRAME, [CLOSE]),
         (BEGIN, [CLOSE]), (ANY, [CLOSE, INTERRUPT])]


class ViewerStressTest(harness.EndToEndTest):

    def setUp(self):
        if not harness.CLIP.exists():  # By hand.
            self.addClassCleanup(shutil.rmtree, harness.WORK)
            self.assert_success(harness.run("render_clip", "desk", harness.CLIP, "--frames",
                                            harness.NUM_FRAMES))
        super().setUp()
        self.screen = xserver.Screen()
        self.addCleanup(self.screen.close)

    def test_no_end_of_window_and_run_does_harm(self):
        chance = random.Random(ARGUMENTS.seed)
        seconds = self.measure()
        for number, (moment, acts) in zip(range(ARGUMENTS.runs), itertools.cycle(CASES)):
            with self.subTest(run=number, moment=moment, acts=acts):
                self.one_run(moment, acts, chance, seconds)

    def start(self, *options):
        program = terminal.Terminal(
            [harness.BIN / "rgbd_tum", harness.VOCABULARY, harness.CLIP / "settings.yaml",
             harness.CLIP, harness.CLIP / "associations.txt", "--output", self.output,
             "--detections", harness.CLIP / "detections", *options], self.screen.environment())
        self.addCleanup(program.close)
        return program

    def measure(self):
        """How long a window is shown if nobody touches it."""
        program = self.start("--viewer")
        self.screen.wait_for_window(program.process)
        begin = time.monotonic()
        program.finish()
        self.check(program, acts=[])
        return time.monotonic() - begin

    def one_run(self, moment, acts, chance, seconds):
        stays = moment == SUMMARY or chance.random() < 0.5
        program = self.start("--viewer-stays" if stays else "--viewer")
        window = self.screen.wait_for_window(program.process, LIMIT)
        if moment == ANY:
            time.sleep(chance.uniform(0, seconds))
        elif moment == LAST_FRAME:
            program.wait_for("finishing: ")
            time.sleep(chance.uniform(0, 0.1 * seconds))
        elif moment == SUMMARY:
            program.wait_for("files  ")
        for act in acts:
            if act == CLOSE and window in self.screen.windows():
                self.screen.close_window(window)
            elif act == INTERRUPT and program.process.poll() is None:
                program.process.send_signal(signal.SIGINT)
        program.finish()
        print(f"{moment}: {' and '.join(acts)}: exit code {program.process.returncode}",
              flush=True)
        self.check(program, acts)

    def check(self, program, acts):
        text, code = program.text, program.process.returncode
        for word in ["Sanitizer", "runtime error", "the run goes on without a viewer"]:
            self.assertNotIn(word, text)
        if code == 1 and INTERRUPT in acts:
            self.assertIn("interrupted before the first frame", text)
            return
        self.assertIn(code, (0, 2) if INTERRUPT in acts else (0,), text)
        self.assertEqual(sorted(path.name for path in self.output.iterdir()), harness.FILES)
        for path in self.output.iterdir():
            path.unlink()


if __name__ == "__main__":
    xserver.skip_if_missing()
    unittest.main(argv=sys.argv[:1])
