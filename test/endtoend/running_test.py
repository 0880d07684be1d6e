# SPDX-FileCopyrightText: 2026 the semslam authors
# SPDX-License-Identifier: BSD-3-Clause
"""rgbd_tum while it runs: on a terminal, in real time, interrupted, and when tracking is lost."""
import fcntl
import json
import os
import pty
import re
import select
import signal
import struct
import subprocess
import termios
import time
import unittest

import formats
import harness
from harness import CLIP, FILES, NUM_FRAMES, EndToEndTest, complaints, images

COLUMNS = 80
RECORDED_SECONDS = (NUM_FRAMES - 1) / 30


class TerminalRun:
    """rgbd_tum with a terminal of 80 columns as its standard error."""

    def __init__(self, output, *options):
        self.master, slave = pty.openpty()
        fcntl.ioctl(slave, termios.TIOCSWINSZ, struct.pack("HHHH", 24, COLUMNS, 0, 0))
        self.text = ""
        self.process = subprocess.Popen(
            [harness.BIN / "rgbd_tum", harness.VOCABULARY, CLIP / "settings.yaml", CLIP, "-",
             "--output", output, *options], stdout=subprocess.PIPE, stderr=slave, text=True)
        os.close(slave)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.kill()
        self.process.communicate()
        os.close(self.master)

    def read(self, until=None):
        """Collects what is shown, up to a text or to the end."""
        end = time.monotonic() + harness.TIMEOUT
        while until is None or until not in self.text:
            if not select.select([self.master], [], [], max(0, end - time.monotonic()))[0]:
                raise TimeoutError(f"waiting for {until}: {self.text}")
            try:
                self.text += os.read(self.master, 4096).decode()
            except OSError:  # The program has closed its end.
                break

    def interrupt(self):
        self.process.send_signal(signal.SIGINT)

    def finish(self):
        self.read()
        self.summary, _ = self.process.communicate(timeout=harness.TIMEOUT)
        return self.process.returncode


class RunningTest(EndToEndTest):

    def assert_whole_files(self):
        self.assertEqual(sorted(path.name for path in self.output.iterdir()), FILES)
        poses = formats.read_trajectory(self.output / "CameraTrajectory.txt")
        formats.read_trajectory(self.output / "KeyFrameTrajectory.txt")
        sizes = {len(formats.read_pcd(self.output / name)["x"]) for name in harness.CLOUDS[:3]}
        sizes.add(len(formats.read_ply(self.output / "semantic_map.ply")["x"]))
        self.assertEqual(len(sizes), 1)
        json.loads((self.output / "objects.json").read_text())
        for name in harness.PICTURES:
            formats.read_png_size(self.output / name)
        return len(poses)

    def test_progress_on_a_terminal_fits_its_width_and_vanishes(self):
        with TerminalRun(self.output, "--realtime") as running:
            self.assertEqual(running.finish(), 0, running.text)
            parts = [part for part in re.split(r"\r\x1b\[K", running.text) if part]
            progress = [part for part in parts if part.startswith("frame ")]
            self.assertGreater(len(progress), 0)
            self.assertLess(max(map(len, parts)), COLUMNS)
            self.assertRegex(progress[-1], rf"frame \d+/{NUM_FRAMES}  [\d.]+/s  tracking  \d+ key")
            self.assertTrue(parts[-1].startswith("finishing"))
            self.assertTrue(running.text.endswith("\r\x1b[K"))
            self.assertNotIn("\n", running.text)

    def test_interrupted_during_the_run_it_writes_what_was_mapped(self):
        with TerminalRun(self.output, "--realtime", "--detections", CLIP / "detections") as running:
            running.read(until="frame ")
            running.interrupt()
            self.assertIn(running.finish(), [0, 2])
            self.assertIn("(interrupted)", running.summary)
            num_poses = self.assert_whole_files()
            self.assertTrue(0 < num_poses < NUM_FRAMES, num_poses)

    def test_interrupted_while_it_finishes_it_still_writes_everything(self):
        with TerminalRun(self.output, "--detections", CLIP / "detections") as running:
            running.read(until="finishing")
            running.interrupt()
            self.assertIn(running.finish(), [0, 2])
            self.assertEqual(self.assert_whole_files(), NUM_FRAMES)

    def test_interrupted_at_any_early_time_it_ends_cleanly(self):
        self.output.mkdir()
        for delay in [0.05, 0.15, 0.3]:
            with self.subTest(delay=delay), TerminalRun(self.output) as running:
                time.sleep(delay)
                running.interrupt()
                code = running.finish()
                if code in (0, 2):
                    self.assert_whole_files()
                elif code == 1:
                    self.assertIn("rgbd_tum: interrupted before the first frame", running.text)
                    self.assert_no_files()
                else:  # Before the program had a say.
                    self.assertEqual(code, -signal.SIGINT)
                    self.assert_no_files()
                for path in self.output.iterdir():
                    path.unlink()

    def test_a_terminate_signal_ends_it_as_well(self):
        with TerminalRun(self.output, "--realtime", "--no-semantics") as running:
            running.read(until="frame ")
            running.process.terminate()
            self.assertIn(running.finish(), [0, 2])
            self.assert_whole_files()

    def test_realtime_takes_the_recorded_time(self):
        start = time.monotonic()
        result = self.map("--realtime", "--no-semantics")
        self.assert_success(result)
        self.assertGreaterEqual(time.monotonic() - start, RECORDED_SECONDS)
        self.assertRegex(result.stdout, rf"late by over a frame +\d+ of {NUM_FRAMES} frames")
        self.assertEqual(self.assert_whole_files(), NUM_FRAMES)

    def test_threads_track_as_well_as_the_sequential_mode(self):
        result = self.map("--detections", CLIP / "detections")
        self.assert_success(result)
        self.assertIn(f"{NUM_FRAMES} tracked, 0 lost", result.stdout)
        self.assertEqual(self.assert_whole_files(), NUM_FRAMES)

    def test_lost_tracking_is_exit_code_2(self):
        clip = self.copy_clip()
        for kind, bit_depth, num_channels in [("rgb", 8, 3), ("depth", 16, 1)]:
            for path in images(clip, kind)[20:26]:
                path.unlink()
                formats.write_png(path, 640, 480, bit_depth, num_channels)
        result = self.map("--no-semantics", clip=clip)
        self.assertEqual(result.returncode, 2, result.stderr)
        tracked, lost = map(int, re.search(r"(\d+) tracked, (\d+) lost", result.stdout).groups())
        self.assertGreaterEqual(lost, 6)
        self.assertEqual(tracked + lost, NUM_FRAMES)
        # A map as young as this may be cleared and begun anew; then it says so.
        cleared = any("map cleared" in line for line in complaints(result))
        self.assertEqual(self.assert_whole_files(), 4 if cleared else tracked)

    def test_a_clip_of_darkness_maps_nothing_and_says_so(self):
        clip = self.copy_clip(num_frames=4)
        for path in images(clip, "rgb")[:4]:
            path.unlink()
            formats.write_png(path, 640, 480)
        result = self.map("--no-semantics", clip=clip)
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertIn("0 tracked, 4 lost", result.stdout)
        self.assertEqual(self.assert_whole_files(), 0)


if __name__ == "__main__":
    unittest.main()
