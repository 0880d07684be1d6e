# SPDX-FileCopyrightText: 2026 the semslam authors
# SPDX-License-Identifier: BSD-3-Clause
"""The windows of view_map and --viewer on a screen in memory."""
import array
import math
import os
import signal
import subprocess
import time
import types
import unittest

import harness
import xserver
from harness import BIN, CLIP, FILES, EndToEndTest, complaints

LIMIT = 240  # Seconds, of one run with a window drawn in software.


def write_waves(path, side):
    """A surface of side x side points, 1 cm apart."""
    heights = [math.sin(i / 50) for i in range(side)]
    values = array.array("f", (value for i in range(side) for j in range(side)
                               for value in (0.01 * i, 0.01 * j, heights[i] * heights[j])))
    path.write_bytes(f"ply\nformat binary_little_endian 1.0\nelement vertex {side * side}\n"
                     "property float x\nproperty float y\nproperty float z\n"
                     "end_header\n".encode() + values.tobytes())


class ViewerTest(EndToEndTest):

    def setUp(self):
        super().setUp()
        self.screen = xserver.Screen()
        self.addCleanup(self.screen.close)

    def start(self, program, *arguments, environment=None):
        process = subprocess.Popen([BIN / program, *map(str, arguments)], stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True,
                                   env=environment or self.screen.environment())
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return process

    def start_run(self, *options, environment=None):
        return self.start("rgbd_tum", harness.VOCABULARY, CLIP / "settings.yaml", CLIP,
                          CLIP / "associations.txt", "--output", self.output, "--detections",
                          CLIP / "detections", *options, environment=environment)

    def finish(self, process):
        """Its lines of complaint, but for the progress."""
        _, process.err = process.communicate(timeout=LIMIT)
        return complaints(types.SimpleNamespace(stderr=process.err))

    def assert_finished_well(self, process):
        lines = self.finish(process)
        self.assertEqual(process.returncode, 0, process.err)
        self.assertEqual(lines, [])
        self.assertEqual(sorted(p.name for p in self.output.iterdir()), FILES)

    def test_the_run_is_shown_and_the_window_goes_with_it(self):
        process = self.start_run("--viewer", "--realtime")
        self.assertIsNotNone(self.screen.wait_for_window(process))
        # The map is in the middle, between the panels.
        self.assertGreater(self.screen.wait_for_colors(300, left=400, right=900), 300)
        self.assert_finished_well(process)
        self.assertEqual(self.screen.windows(), [])

    def test_a_window_that_stays_is_closed_by_the_user(self):
        process = self.start_run("--viewer-stays")
        window = self.screen.wait_for_window(process)
        summary = ""
        while "files " not in summary:
            summary = process.stdout.readline()
            self.assertNotEqual(summary, "", "the summary came to no end")
        time.sleep(1)
        self.assertIsNone(process.poll())
        self.screen.close_window(window)
        self.finish(process)
        self.assertEqual(process.returncode, 0, process.err)

    def test_without_a_screen_the_run_goes_on_and_says_so(self):
        environment = {name: value for name, value in os.environ.items()
                       if name not in ("DISPLAY", "WAYLAND_DISPLAY")}
        process = self.start_run("--viewer", environment=environment)
        lines = self.finish(process)
        self.assertEqual(process.returncode, 0, process.err)
        self.assertEqual(len(lines), 1, process.err)
        self.assertIn("the run goes on without a viewer: no window", lines[0])
        self.assertEqual(sorted(p.name for p in self.output.iterdir()), FILES)

    def test_a_sequential_run_writes_the_same_with_a_window(self):
        def clouds():
            return [(self.output / name).read_bytes() for name in harness.CLOUDS]
        process = self.start_run("--sequential")
        self.assert_finished_well(process)
        without = clouds()
        process = self.start_run("--sequential", "--viewer")
        self.assert_finished_well(process)
        self.assertEqual(clouds(), without)

    def test_a_map_is_shown_until_its_window_is_closed_or_an_interrupt(self):
        self.assert_finished_well(self.start_run())
        process = self.start("view_map", self.output, "--color", "classes")
        window = self.screen.wait_for_window(process)
        self.assertGreater(self.screen.wait_for_colors(300, left=400), 300)
        time.sleep(0.5)
        self.screen.close_window(window)
        self.assertEqual(self.finish(process), [])
        self.assertEqual(process.returncode, 0)
        process = self.start("view_map", self.output)
        self.screen.wait_for_window(process)
        process.send_signal(signal.SIGINT)
        self.finish(process)
        self.assertEqual(process.returncode, 0, process.err)

    def test_a_million_points_are_seen_within_two_seconds(self):
        cloud = self.folder / "cloud.ply"
        write_waves(cloud, 1000)
        times = [math.inf]
        while len(times) < 4 and times[-1] >= 2:  # Again if something else took the cores.
            begin = time.monotonic()
            process = self.start("view_map", cloud, "--color", "height")
            window = self.screen.wait_for_window(process)
            self.assertGreater(self.screen.wait_for_colors(40, top=400, bottom=420), 40)
            times.append(time.monotonic() - begin)
            self.screen.close_window(window)
            self.assertEqual(self.finish(process), [])
        print(f"1 million points: first picture after {min(times):.2f} s")
        self.assertLess(min(times), 2)


if __name__ == "__main__":
    xserver.skip_if_missing()
    unittest.main()
