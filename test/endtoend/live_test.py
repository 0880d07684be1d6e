# SPDX-FileCopyrightText: 2026 the semslam authors
# SPDX-License-Identifier: BSD-3-Clause
"""rgbd_openni2 with a camera that is not there: the real OpenNI2, with a driver of test/live/driver
that plays a clip in real time and has faults by a script.

CMake gives the folder of that OpenNI2 in SEMSLAM_OPENNI2.
"""
import concurrent.futures
import os
import re
import signal
import subprocess
import time
import unittest

import formats
import harness
import terminal
import xserver
from harness import CLIP, FILES, EndToEndTest, images, run

FPS = 30
OPENNI2 = os.environ["SEMSLAM_OPENNI2"]
FIRST_TIME = 1000.0  # Of the clip, seconds.


def there_and_back(path, seconds, num_images=harness.NUM_FRAMES):
    """Associations that show the clip forwards and backwards, over and over."""
    entries = [line.split() for line in (CLIP / "associations.txt").read_text().splitlines()]
    circle = entries[:num_images] + entries[num_images - 2:0:-1]
    with open(path, "w", encoding="ascii") as file:
        for i in range(int(seconds * FPS)):
            color, depth = circle[i % len(circle)][1::2]
            file.write(f"{FIRST_TIME + i / FPS:.6f} {color} {FIRST_TIME + i / FPS:.6f} {depth}\n")
    return path


def true_trajectory(path, associations):
    """The truth of a clip that goes there and back."""
    poses = {}
    for line in (CLIP / "groundtruth.txt").read_text().splitlines():
        if not line.startswith("#"):
            seconds, pose = line.split(maxsplit=1)
            poses[f"{float(seconds):.6f}"] = pose
    lines = []
    for line in associations.read_text().splitlines():
        seconds, color = line.split()[:2]
        lines.append(f"{seconds} {poses[os.path.splitext(os.path.basename(color))[0]]}\n")
    path.write_text("".join(lines))
    return path


class LiveTest(EndToEndTest):
    """Runs with a script for the camera."""

    @classmethod
    def setUpClass(cls):
        cls.clip = there_and_back(harness.WORK / "there_and_back.txt", 20)
        cls.truth = true_trajectory(harness.WORK / "there_and_back_truth.txt", cls.clip)
        # The dense map is not what is looked at here.
        cls.settings = harness.WORK / "live.yaml"
        cls.settings.write_text((CLIP / "settings.yaml").read_text() +
                                "PointCloudMapping.pixelStride: 8\n"
                                "PointCloudMapping.voxelSize: 0.04\n"
                                "Segmentation.voxelSize: 0.04\nSegmentation.seedSpacing: 0.2\n")
        cls.show_clip = f"clip {CLIP} {cls.clip} 5000\n"

    def environment(self, script=None, name="camera"):
        path = self.folder / f"{name}.txt"
        path.write_text(self.show_clip if script is None else script)
        return {**os.environ, "LD_LIBRARY_PATH": OPENNI2, "SEMSLAM_TEST_CAMERA": str(path)}

    def arguments(self, *options, output=None):
        return [harness.VOCABULARY, self.settings, "--no-semantics", "--output",
                output or self.output, *options]

    def live(self, *options, script=None, output=None, name="camera"):
        return run("rgbd_openni2", *self.arguments(*options, output=output),
                   env=self.environment(script, name))

    def assert_whole_files(self, output=None):
        output = output or self.output
        self.assertEqual(sorted(path.name for path in output.iterdir()), FILES)
        return formats.read_trajectory(output / "CameraTrajectory.txt")

    def error(self, first, output=None):
        """Of a trajectory that begins with this image of the clip, in metres."""
        rows = formats.read_trajectory((output or self.output) / "CameraTrajectory.txt")
        shift = FIRST_TIME + first / FPS - rows[0][0]
        path = self.folder / "shifted.txt"
        path.write_text("".join(f"{row[0] + shift:.6f} " + " ".join(map(str, row[1:])) + "\n"
                                for row in rows))
        result = run("evaluate_trajectory", self.truth, path)
        self.assert_success(result)
        return float(re.search(r"ATE +rmse ([\d.]+) m", result.stdout).group(1))


class MappingTest(LiveTest):

    def test_a_camera_gives_the_map_that_files_give(self):
        result = self.live("--duration", 2)
        self.assert_success(result)
        num_tracked, num_lost = map(
            int, re.search(r"(\d+) tracked, (\d+) lost", result.stdout).groups())
        self.assertEqual(num_lost, 0)
        self.assertGreaterEqual(num_tracked, 20)  # Of 60, on a machine that is busy.
        self.assertEqual(len(self.assert_whole_files()), num_tracked)
        self.assertRegex(result.stdout, r"dropped +\d+ of \d+ images")
        self.assertRegex(result.stdout, r"frame to pose +median [\d.]+ ms, p95 [\d.]+ ms")
        # The camera sends already while the program gets ready.
        self.assertLess(min(self.error(first) for first in range(8)), 0.003)

    def map_files(self, clip, associations, output):
        """By rgbd_tum; returns the poses."""
        self.assert_success(self.map("--sequential", "--no-semantics", clip=clip,
                                     settings=self.settings, associations=associations,
                                     output=output))
        return self.assert_whole_files(output)

    def test_a_recording_gives_the_map_of_the_camera_and_of_files(self):
        recording = self.folder / "clip.oni"
        self.assert_success(self.live("--duration", 1, "--record", recording))
        sequence = self.folder / "sequence"
        played = self.folder / "played"
        self.assert_success(self.live("--device", recording, "--record-tum", sequence,
                                      "--sequential", output=played))
        poses = self.assert_whole_files(played)
        self.assertGreaterEqual(len(poses), 10)  # Of 30, on a machine that is busy.

        # The sequence that was made of it gives the same map.
        others = self.map_files(sequence, sequence / "associations.txt", self.folder / "mapped")
        self.assertEqual(len(poses), len(others))
        for pose, other in zip(poses, others):
            for value, expected in zip(pose, other):
                self.assertAlmostEqual(value, expected, delta=2e-6)

        # Colours are those of the clip to the bit: so it is known which images these are.
        lines = self.clip.read_text().splitlines(keepends=True)
        color = images(sequence, "rgb")[0].read_bytes()
        first = next(i for i, line in enumerate(lines)
                     if (CLIP / line.split()[1]).read_bytes() == color)
        associations = self.folder / "associations.txt"
        associations.write_text("".join(lines[first:first + len(poses)]))
        self.map_files(CLIP, associations, self.folder / "clip")
        expected = self.error(first, self.folder / "clip")
        self.assertLess(abs(self.error(first, played) - expected), 0.05 * expected + 1.5e-4)

    def test_a_map_can_be_gone_on_from_and_localised_in(self):
        saved = self.folder / "saved.map"
        self.assert_success(self.live("--duration", 1.5, "--save-map", saved))
        found = self.live("--load-map", saved, "--localization", "--duration", 0.7,
                          output=self.folder / "found")
        self.assert_success(found)
        self.assertRegex(found.stdout, r", 0 lost")
        keyframes = formats.read_trajectory(self.output / "KeyFrameTrajectory.txt")
        self.assertEqual(
            formats.read_trajectory(self.folder / "found" / "KeyFrameTrajectory.txt"), keyframes)
        gone_on = self.live("--load-map", saved, "--duration", 0.5, output=self.folder / "gone_on")
        self.assert_success(gone_on)
        more = formats.read_trajectory(self.folder / "gone_on" / "KeyFrameTrajectory.txt")
        self.assertEqual(more[:1], keyframes[:1])
        self.assertGreaterEqual(len(more), len(keyframes))


class FaultTest(LiveTest):
    """Each fault for a while, side by side: reported, survived, files written."""

    FAULTS = {
        "unplug 1 0.7": "camera: the camera was unplugged; waiting up to 10.0 s",
        "stall 1 1.5": "camera: no images for ",
        "no_color 1 1.5": "camera: no colour images for ",
        "no_depth 1 1.5": "camera: no depth images for ",
        "format 1 0.7": "camera: expected colour images of 640x480, 30/s, RGB888, found 320x240",
    }

    def run_fault(self, fault, *options):
        output = self.folder / fault.replace(" ", "_")
        output.mkdir()
        return output, self.live(*options, script=self.show_clip + fault, output=output,
                                 name=output.name)

    def test_each_fault_is_survived(self):
        with concurrent.futures.ThreadPoolExecutor() as pool:
            runs = pool.map(
                lambda fault: self.run_fault(fault, "--duration", 3.2, "--reconnect", 10,
                                             "--save-map", self.folder / f"{fault}.map"),
                self.FAULTS)
        for (fault, message), (output, result) in zip(self.FAULTS.items(), runs):
            with self.subTest(fault=fault):
                self.assertIn(result.returncode, [0, 2], result.stderr)
                self.assertIn(message, result.stderr)
                self.assertIn("camera: images come again after", result.stderr)
                poses = self.assert_whole_files(output)
                self.assertGreater(poses[-1][0] - poses[0][0], 1.5)
                # In one frame of reference: so the place was found again.
                self.assertLess(min(self.error(first, output) for first in range(10)), 0.02)
                self.assertGreater((self.folder / f"{fault}.map").stat().st_size, 10000)

    def test_a_camera_that_stays_away_ends_the_run_with_files_and_exit_code_3(self):
        output, result = self.run_fault("unplug 1 100", "--reconnect", 0.5, "--record",
                                        self.folder / "clip.oni")
        self.assertEqual(result.returncode, 3, result.stderr)
        self.assertIn("rgbd_openni2: the camera did not come back within 0.5 s", result.stderr)
        self.assertGreater(len(self.assert_whole_files(output)), 5)
        # What was recorded before can be played, and what is left of it if it is cut short.
        recording = self.folder / "clip.oni"
        self.assert_success(self.live("--device", recording))
        os.truncate(recording, recording.stat().st_size // 3)
        cut = self.folder / "cut"
        result = self.live("--device", recording, output=cut)
        self.assertEqual(result.returncode, 3, result.stderr)
        self.assertRegex(result.stderr, r"rgbd_openni2: .*clip.oni: the recording .* was cut short")
        self.assertGreater(len(self.assert_whole_files(cut)), 5)

    def interrupt(self, fault, message):
        """Once some frames came, and, with a fault, once it was told."""
        output = self.folder / (fault[:4] or "none")
        output.mkdir()
        frames = self.folder / (output.name + "_frames")
        errors = self.folder / (output.name + ".log")
        with open(errors, "w", encoding="utf-8") as log, subprocess.Popen(
                [harness.BIN / "rgbd_openni2",
                 *map(str, self.arguments("--record-tum", frames, output=output))],
                env=self.environment(self.show_clip + fault, name=output.name), text=True,
                stdout=subprocess.PIPE, stderr=log) as process:
            end = time.monotonic() + harness.TIMEOUT
            while (len(list(frames.glob("rgb/*.png"))) < 10 or
                   message not in errors.read_text()) and time.monotonic() < end:
                time.sleep(0.05)
            process.send_signal(signal.SIGINT)
            summary, _ = process.communicate(timeout=harness.TIMEOUT)
        return process.returncode, summary, errors.read_text(), output

    def test_interrupted_it_writes_what_was_mapped(self):
        for fault, message in [("", ""), ("unplug 0.7 100", "was unplugged")]:
            with self.subTest(fault=fault):
                code, summary, errors, output = self.interrupt(fault, message)
                self.assertIn(code, [0, 2], errors)
                self.assertIn("(interrupted)", summary)
                self.assertGreater(len(self.assert_whole_files(output)), 5)


class TerminalTest(LiveTest):

    PROGRESS = r"frame \d+  [\d.]+/s  \d+ dropped  \d+/\d+ ms late  tracking  \d+ keyframes"

    def start(self, *options, environment):
        program = terminal.Terminal([harness.BIN / "rgbd_openni2", *self.arguments(*options)],
                                    {**self.environment(), **environment})
        self.addCleanup(program.close)
        return program

    def finish(self, program):
        program.process.send_signal(signal.SIGINT)
        program.finish()
        self.assertIn(program.process.returncode, [0, 2], program.text)
        self.assertIn("(interrupted)", program.text)
        self.assert_whole_files()

    def test_progress_tells_rate_drops_lateness_and_state(self):
        program = self.start(environment={})
        program.wait_for(self.PROGRESS)
        self.finish(program)
        self.assertRegex(program.text, self.PROGRESS)

    @unittest.skipIf(not (harness.BIN / "view_map").exists() or xserver.IS_SKIPPED,
                     "no viewer or screen")
    def test_a_window_shows_the_camera_until_an_interrupt(self):
        screen = xserver.Screen()
        self.addCleanup(screen.close)
        program = self.start("--viewer", "--device", "clip@1", environment={"DISPLAY": screen.name})
        self.assertIsNotNone(screen.wait_for_window(program.process))
        self.assertGreater(screen.wait_for_colors(300, left=400, right=900), 300)
        self.finish(program)
        self.assertEqual(screen.windows(), [])
        self.assertNotIn("without a viewer", program.text)


class RefusalTest(LiveTest):

    def refuse(self, result, *words):
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertTrue(result.stderr.startswith("rgbd_openni2: "), result.stderr)
        for word in words:
            self.assertIn(word, result.stderr)
        self.assert_no_files()

    def test_no_camera_is_refused_with_the_next_step(self):
        self.refuse(self.live(script="absent\n"), "no camera found", "lsusb")
        self.refuse(run("rgbd_openni2", "--list", env=self.environment("absent\n")),
                    "no camera found")

    def test_a_camera_in_use_is_refused_with_the_next_step(self):
        self.refuse(self.live(script="locked Resource busy\n"), "Resource busy", "end that one first")

    def test_a_camera_that_does_not_register_is_refused_unless_allowed(self):
        self.refuse(self.live(script="refuse registration\n"), "--unregistered")
        allowed = self.live("--unregistered", "--duration", 0.3,
                            script=self.show_clip + "refuse registration\n")
        self.assert_success(allowed)
        self.assertIn("depth is not registered", allowed.stderr)

    def test_a_recording_that_is_none_is_refused(self):
        recording = self.folder / "clip.oni"
        self.refuse(self.live("--device", recording), "clip.oni", "found nothing")
        recording.write_text("not one")
        self.refuse(self.live("--device", recording), "clip.oni", "NI10")
        recording.write_text("NI10 and nothing else")
        self.refuse(self.live("--device", recording), "clip.oni", "cut short")

    def test_a_place_for_a_recording_that_cannot_be_is_refused(self):
        blocked = self.folder / "file"
        blocked.touch()
        self.refuse(self.live("--record", blocked / "clip.oni"), str(blocked))
        full = self.folder / "full"
        full.mkdir()
        (full / "file").touch()
        self.refuse(self.live("--record-tum", full), "expected a new or empty folder")

    def test_the_list_needs_nothing_else(self):
        result = run("rgbd_openni2", "--list", env=self.environment("size 640 480\n"))
        self.assert_success(result)
        self.assertIn("clip@1  semslam Virtual camera", result.stdout)
        self.assertRegex(result.stdout, r"640x480 +30/s +RGB888")
        self.assertRegex(result.stdout, r"640x480 +30/s +1 mm")

    def test_the_field_of_view_gives_intrinsics_with_a_warning(self):
        saved = self.folder / "saved.map"
        result = self.live("--device-intrinsics", "--duration", 0.3, "--save-map", saved)
        self.assertIn(result.returncode, [0, 2])
        self.assertIn("warning: focal lengths 570", result.stderr)
        self.assertIn("Camera.fx: 570", saved.read_bytes().decode("latin-1"))


if __name__ == "__main__":
    unittest.main()
