# SPDX-FileCopyrightText: 2026 the semslam authors
# SPDX-License-Identifier: BSD-3-Clause
"""The segmentation alone, on a cloud of rgbd_tum."""
import array
import json
import os
import signal
import unittest

import formats
import harness
from harness import CLIP, EndToEndTest, run
from terminal import Terminal


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

    def test_interrupted_it_writes_nothing_and_keeps_what_was_there(self):
        cloud = self.folder / "large.pcd"
        write_floors(cloud)
        out = self.folder / "out.pcd"
        planes = self.folder / "planes.json"
        out.write_text("of an earlier run")
        for step in ["reading", "voxels", "normals"]:
            terminal = Terminal([harness.BIN / "segment_cloud", cloud, out, "--planes", planes],
                                dict(os.environ))
            self.addCleanup(terminal.close)
            with self.subTest(step):
                terminal.wait_for(step)
                terminal.process.send_signal(signal.SIGINT)
                terminal.finish()
                self.assertEqual(terminal.process.returncode, 130, terminal.text)
                self.assertIn("segment_cloud: interrupted, nothing was written", terminal.text)
                self.assertEqual(out.read_text(), "of an earlier run")
                self.assertEqual(sorted(path.name for path in self.folder.iterdir()),
                                 ["large.pcd", "out.pcd"])


def write_floors(path):
    """Ten floors of 250 x 250 points, so many that segmenting them takes a while."""
    points = array.array("f", (c for z in range(10) for x in range(250) for y in range(250)
                               for c in (0.007 * x, 0.007 * y, 0.5 * z)))
    count = len(points) // 3
    header = ["VERSION 0.7", "FIELDS x y z", "SIZE 4 4 4", "TYPE F F F", "COUNT 1 1 1",
              f"WIDTH {count}", "HEIGHT 1", "VIEWPOINT 0 0 0 1 0 0 0", f"POINTS {count}",
              "DATA binary", ""]
    path.write_bytes("\n".join(header).encode() + points.tobytes())


if __name__ == "__main__":
    unittest.main()
