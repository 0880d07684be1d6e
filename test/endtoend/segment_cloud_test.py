# SPDX-FileCopyrightText: 2026 the semslam authors
# SPDX-License-Identifier: BSD-3-Clause
"""The segmentation alone, on a cloud of rgbd_tum."""
import json
import unittest

import formats
import harness
from harness import CLIP, EndToEndTest, run


class SegmentCloudTest(EndToEndTest):

    cloud = harness.WORK / "to_segment" / "global_color.pcd"

    @classmethod
    def setUpClass(cls):
        run("rgbd_tum", harness.VOCABULARY, CLIP / "settings.yaml", CLIP,
            CLIP / "associations.txt", "--output", cls.cloud.parent, "--sequential",
            "--no-semantics")

    def test_every_method_gives_the_same_points_with_segments(self):
        points = formats.read_pcd(self.cloud)["x"]
        for method in ["graph", "lccp", "region-growing"]:
            with self.subTest(method):
                out = self.folder / f"{method}.pcd"
                self.assert_success(run("segment_cloud", self.cloud, out, "--method", method))
                result = formats.read_pcd(out)
                self.assertEqual(result["x"], points)
                self.assertGreater(len(set(result["segment"])), 3)

    def test_planes_and_segments_are_told(self):
        planes = self.folder / "planes.json"
        self.assert_success(
            run("segment_cloud", self.cloud, self.folder / "out.pcd", "--planes", planes))
        root = json.loads(planes.read_text())
        self.assertGreater(len(root["planes"]), 1)
        for plane in root["planes"]:
            self.assertAlmostEqual(sum(n * n for n in plane["normal"]), 1, places=6)
        self.assertGreater(len(root["segments"]), 3)

    def test_what_is_no_cloud_is_refused(self):
        for path in [self.folder / "nothing.pcd", CLIP / "settings.yaml"]:
            result = run("segment_cloud", path, self.folder / "out.pcd")
            self.assertEqual(result.returncode, 1)
            self.assertIn(str(path), result.stderr)
            self.assertFalse((self.folder / "out.pcd").exists())


if __name__ == "__main__":
    unittest.main()
