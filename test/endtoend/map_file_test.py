# SPDX-FileCopyrightText: 2026 the semslam authors
# SPDX-License-Identifier: BSD-3-Clause
"""Maps that are saved, looked at, gone on from and localised in."""
import unittest

import formats
import harness
from harness import CLIP, MAP_FILES, NUM_FRAMES, EndToEndTest, run

OPTIONS = ["--sequential", "--detections", CLIP / "detections"]


class MapFileTest(EndToEndTest):
    """One run that saves its map."""

    saved = harness.WORK / "saved"
    map_file = harness.WORK / "saved.map"

    @classmethod
    def setUpClass(cls):
        cls.summary = run("rgbd_tum", harness.VOCABULARY, CLIP / "settings.yaml", CLIP,
                          CLIP / "associations.txt", "--output", cls.saved, "--save-map",
                          cls.map_file, *OPTIONS)

    def load(self, *options, **keywords):
        return self.map("--load-map", self.map_file, *OPTIONS, *options, **keywords)

    def test_the_files_come_out_of_the_map_to_the_byte(self):
        self.assert_success(self.summary)
        result = run("map_info", self.map_file, "--output", self.output)
        self.assert_success(result)
        for name in MAP_FILES:
            self.assertTrue((self.saved / name).read_bytes() == (self.output / name).read_bytes(),
                            f"{name} differs")

    def test_map_info_says_what_is_in_it(self):
        result = run("map_info", self.map_file)
        self.assert_success(result)
        self.assertRegex(result.stdout, rf"frames +{NUM_FRAMES}, ")
        self.assertRegex(result.stdout, r"keyframes +\d+\n")
        num_points = len(formats.read_pcd(self.saved / "global_color.pcd")["x"])
        self.assertRegex(result.stdout, rf"map points +{num_points}\n")

    def test_a_second_run_goes_on_in_the_map(self):
        self.assert_success(self.load())
        poses = formats.read_trajectory(self.output / "CameraTrajectory.txt")
        self.assertGreaterEqual(len(poses), NUM_FRAMES - 1)
        first = formats.read_trajectory(self.saved / "CameraTrajectory.txt")
        for pose, expected in zip(poses[-5:], first[-5:]):  # In the same world.
            for value, other in zip(pose[1:4], expected[1:4]):
                self.assertAlmostEqual(value, other, delta=0.02)

    def test_localisation_leaves_the_map_as_it_is(self):
        self.assert_success(self.load("--localization"))
        name = "KeyFrameTrajectory.txt"
        self.assertEqual((self.saved / name).read_text(), (self.output / name).read_text())

    def test_localisation_needs_a_map(self):
        self.assert_refused(self.map("--localization"), "--load-map")

    def test_a_map_of_another_camera_is_refused(self):
        settings = self.folder / "settings.yaml"
        text = (CLIP / "settings.yaml").read_text()
        settings.write_text(text.replace("Camera.fx: 5", "Camera.fx: 6"))
        self.assert_refused(self.load(settings=settings), "saved.map", "Camera.fx")

    def test_what_is_no_map_is_refused(self):
        for path in [CLIP / "settings.yaml", self.folder / "nothing.map", CLIP]:
            self.assert_refused(self.map("--load-map", path), str(path))
            self.assertEqual(run("map_info", path).returncode, 1)

    def test_a_place_that_cannot_be_written_is_refused_before_the_run(self):
        result = self.map("--save-map", "/proc/self/map")
        self.assert_refused(result, "/proc/self")


if __name__ == "__main__":
    unittest.main()
