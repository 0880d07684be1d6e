# SPDX-FileCopyrightText: 2026 the semslam authors
# SPDX-License-Identifier: BSD-3-Clause
"""rgbd_tum --network and --detections with files that do not fit or are damaged."""
import os
import shutil
import struct
import unittest

import formats
from harness import CLIP, SOURCE, EndToEndTest

YOLO = SOURCE.parent / "shared" / "data" / "yolo"

# The smallest network with a head: 1x1 convolutions on 32x32 pixels, three anchors.
TINY_CFG = """[net]
width=32
height=32
channels=3
[maxpool]
size=2
stride=2
[convolutional]
filters={filters}
size=1
stride=1
pad=1
activation=linear
[yolo]
mask=0,1,2
anchors=4,4, 8,8, 16,16
classes={classes}
num=3
"""


class NetworkTest(EndToEndTest):

    def make_network(self, num_classes, name="tiny"):
        """A network that sees nothing: its weights are 0 but for the objectness."""
        filters = 3 * (5 + num_classes)
        cfg = self.folder / f"{name}.cfg"
        cfg.write_text(TINY_CFG.format(filters=filters, classes=num_classes))
        biases = [-20.0 if i % (5 + num_classes) == 4 else 0.0 for i in range(filters)]
        weights = self.folder / f"{name}.weights"
        weights.write_bytes(struct.pack("<iiiq", 0, 2, 0, 0) +
                            struct.pack(f"<{filters}f", *biases) + bytes(4 * 3 * filters))
        names = self.folder / f"{name}.names"
        names.write_text("".join(f"thing {i}\n" for i in range(num_classes)))
        return cfg, weights, names

    def refuse(self, network, *words):
        self.assert_refused(self.map("--network", *network), *words)

    def test_a_network_that_sees_nothing_gives_a_map_without_objects(self):
        result = self.map("--network", *self.make_network(2), clip=self.copy_clip(num_frames=4))
        self.assert_success(result)
        self.assertRegex(result.stdout, r"objects +0\n")
        self.assertEqual(set(formats.read_pcd(self.output / "semantic_map.pcd")["label"]), {0})

    def test_missing_files_of_a_network_are_refused(self):
        network = self.make_network(2)
        for path in network:
            with self.subTest(path.name):
                kept = path.rename(self.folder / "kept")
                self.refuse(network, path.name)
                kept.rename(path)

    def test_truncated_weights_are_refused(self):
        network = self.make_network(2)
        content = network[1].read_bytes()
        for size in [0, 10, 20, len(content) // 2, len(content) - 1]:
            network[1].write_bytes(content[:size])
            self.refuse(network, "tiny.weights", "expected", str(size))

    def test_weights_of_another_network_are_refused(self):
        cfg, _, names = self.make_network(2)
        _, weights, _ = self.make_network(7, "other")
        self.refuse((cfg, weights, names), "other.weights", "tiny.cfg", "expected")

    def test_names_of_another_length_are_refused(self):
        cfg, weights, _ = self.make_network(2)
        for number in [1, 3]:
            _, _, names = self.make_network(number, "other")
            self.refuse((cfg, weights, names), "tiny.cfg", "classes=2", str(number))

    def test_empty_names_are_refused(self):
        network = self.make_network(2)
        network[2].write_text("")
        self.refuse(network, "tiny.names", "none")

    def test_a_cfg_that_is_none_is_refused(self):
        network = self.make_network(2)
        text = network[0].read_text()
        for content, word in [("", "[net]"), ("hello\n", "tiny.cfg:1"),
                              (text.split("[yolo]", maxsplit=1)[0], "[yolo]"),
                              (text.replace("=32", "=33", 1), "33"),
                              (text.replace("filters=21", "filters=many"), "many"),
                              (text.replace("filters=21", "filters=20"), "21"),
                              (text.replace("[maxpool]", "[magic]"), "magic")]:
            network[0].write_text(content)
            self.refuse(network, "tiny.cfg", word)
        network[0].write_bytes((CLIP / "rgb.txt").read_bytes())
        self.refuse(network, "tiny.cfg")

    def test_an_unknown_class_of_interest_is_refused(self):
        result = self.map("--network", *self.make_network(2), "--classes", "thing 0,unicorn")
        self.assert_refused(result, "unicorn")

    def test_classes_without_a_network_are_refused(self):
        self.assert_refused(self.map("--classes", "cup"), "--network")


class RealNetworkTest(EndToEndTest):

    def setUp(self):
        super().setUp()
        if not YOLO.is_dir():
            self.assertNotIn("SEMSLAM_REQUIRE_CLIPS", os.environ, f"{YOLO} is not there")
            self.skipTest(f"no network in {YOLO}")

    def network(self, cfg="yolo-fastest-1.1-xl", weights="yolo-fastest-1.1-xl"):
        return [YOLO / f"{cfg}.cfg", YOLO / f"{weights}.weights", YOLO / "coco.names"]

    def test_truncated_weights_are_refused(self):
        network = self.network()
        cut = self.folder / "cut.weights"
        cut.write_bytes(network[1].read_bytes()[:-4])
        self.assert_refused(self.map("--network", network[0], cut, network[2]), "cut.weights",
                            "expected", "cut short")

    def test_cfg_and_weights_of_different_networks_are_refused(self):
        network = self.network(weights="yolo-fastest-1.1")
        self.assert_refused(self.map("--network", *network), "yolo-fastest-1.1.weights", "expected")
        network = self.network(cfg="yolo-fastest-1.1")
        self.assert_refused(self.map("--network", *network), "yolo-fastest-1.1-xl.weights")

    def test_names_of_another_length_are_refused(self):
        network = self.network()
        names = self.folder / "short.names"
        names.write_text("".join(network[2].read_text().splitlines(keepends=True)[:-1]))
        self.assert_refused(self.map("--network", *network[:2], names), "79")


class DetectionsTest(EndToEndTest):

    def copy_detections(self):
        return shutil.copytree(CLIP / "detections", self.folder / "detections")

    def test_a_missing_folder_is_refused(self):
        self.assert_refused(self.map("--detections", self.folder / "none"), "none")

    def test_detections_without_class_names_are_refused(self):
        folder = self.copy_detections()
        (folder / "classes.names").unlink()
        self.assert_refused(self.map("--detections", folder), "classes.names")

    def test_a_line_that_is_no_detection_is_refused(self):
        folder = self.copy_detections()
        first = min(folder.glob("*.txt"))
        for line in ["1 0.5 0.5 0.1", "1 0.5 0.5 0.1 wide", "1 0.5 0.5 0.1 1.5", "999 .5 .5 .1 .1",
                     "1 0.5 nan 0.1 0.1", "1 0.5 0.5 0.1 0.1 0.9 more"]:
            with self.subTest(line):
                first.write_text(line + "\n")
                self.assert_refused(self.map("--detections", folder), first.name + ":1", line)


if __name__ == "__main__":
    unittest.main()
