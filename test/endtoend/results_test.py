# SPDX-FileCopyrightText: 2026 the semslam authors
# SPDX-License-Identifier: BSD-3-Clause
"""The files of a run are there, fit each other and the truth, and are the same in a second run."""
import collections
import itertools
import json
import math
import subprocess
import sys
import unittest

import formats
import harness
from harness import CLIP, FILES, MAP_FILES, NUM_FRAMES, EndToEndTest, complaints, run

NO_DETECTOR_FILES = ["CameraTrajectory.txt", "KeyFrameTrajectory.txt", "global_color.pcd",
                     "segmentation.pcd"]
SEQUENTIAL = ["--sequential", "--detections", CLIP / "detections"]


class ResultsTest(EndToEndTest):
    """One run, looked at from all sides."""

    first = None  # Summary and folder of the run, made by the first test.

    @classmethod
    def setUpClass(cls):
        cls.first = harness.WORK / "first"
        cls.summary = run("rgbd_tum", harness.VOCABULARY, CLIP / "settings.yaml", CLIP,
                          CLIP / "associations.txt", "--output", cls.first, *SEQUENTIAL)

    def objects(self):
        return json.loads((self.first / "objects.json").read_text())

    def test_the_run_succeeds_and_leaves_exactly_its_files(self):
        self.assert_success(self.summary)
        self.assertEqual(complaints(self.summary), [])
        self.assertEqual(sorted(path.name for path in self.first.iterdir()), FILES)

    def test_the_summary_says_what_was_done(self):
        for pattern in [rf"frames +{NUM_FRAMES} tracked, 0 lost, 0 unreadable",
                        r"tracking time +median \d+\.\d ms, p95 \d+\.\d ms",
                        r"keyframes +\d+", r"landmarks +\d+", r"map points +\d+",
                        r"segments +\d+", r"objects +\d+: ", r"images labelled +\d+ of \d+",
                        r"labels fused +in \d+ ms, \d+\.\d ms a keyframe",
                        r"peak memory +\d+ MB", rf"files +{self.first}\n"]:
            self.assertRegex(self.summary.stdout, pattern)

    def test_every_frame_has_a_pose_at_its_time(self):
        poses = formats.read_trajectory(self.first / "CameraTrajectory.txt")
        truth = formats.read_trajectory(CLIP / "groundtruth.txt")
        self.assertEqual([pose[0] for pose in poses], [pose[0] for pose in truth])
        for value, expected in zip(poses[0][1:], (0, 0, 0, 0, 0, 0, 1)):
            self.assertAlmostEqual(abs(value), expected, places=6)

    def test_keyframes_are_frames(self):
        poses = formats.read_trajectory(self.first / "CameraTrajectory.txt")
        keyframes = formats.read_trajectory(self.first / "KeyFrameTrajectory.txt")
        self.assertGreater(len(keyframes), 0)
        frames = {pose[0]: pose for pose in poses}
        for keyframe in keyframes:
            for value, expected in zip(keyframe, frames[keyframe[0]]):
                self.assertAlmostEqual(value, expected, places=5)

    def test_the_trajectory_is_right(self):
        result = run("evaluate_trajectory", "--json", CLIP / "groundtruth.txt",
                     self.first / "CameraTrajectory.txt")
        self.assert_success(result)
        error = json.loads(result.stdout)
        self.assertEqual(error["num_pairs"], NUM_FRAMES)
        self.assertLess(error["ate_m"]["rmse"], 0.02)

    def test_all_clouds_have_the_same_points(self):
        clouds = [formats.read_pcd(self.first / name)
                  for name in ["global_color.pcd", "segmentation.pcd", "semantic_map.pcd"]]
        clouds.append(formats.read_ply(self.first / "semantic_map.ply"))
        self.assertGreater(len(clouds[0]["x"]), 10_000)
        for cloud in clouds[1:]:
            for axis in "xyz":
                self.assertEqual(list(cloud[axis]), list(clouds[0][axis]))
        for axis in "xyz":
            self.assertTrue(all(map(math.isfinite, clouds[0][axis])))
        self.assertIn(f"{len(clouds[0]['x'])}", self.summary.stdout)

    def test_clouds_have_their_fields(self):
        self.assertEqual(list(formats.read_pcd(self.first / "global_color.pcd")),
                         ["x", "y", "z", "rgba"])
        self.assertEqual(list(formats.read_pcd(self.first / "segmentation.pcd")),
                         ["x", "y", "z", "label"])
        self.assertEqual(list(formats.read_pcd(self.first / "semantic_map.pcd")),
                         ["x", "y", "z", "rgba", "label"])
        self.assertLessEqual({"x", "y", "z", "red", "green", "blue", "label", "segment", "object",
                              "confidence", "entropy"},
                             set(formats.read_ply(self.first / "semantic_map.ply")))

    def test_pcd_and_ply_have_the_same_labels_segments_and_colours(self):
        ply = formats.read_ply(self.first / "semantic_map.ply")
        semantic = formats.read_pcd(self.first / "semantic_map.pcd")
        segments = formats.read_pcd(self.first / "segmentation.pcd")
        self.assertEqual(list(ply["label"]), list(semantic["label"]))
        self.assertEqual(list(ply["segment"]), list(segments["label"]))
        packed = [255 << 24 | r << 16 | g << 8 | b
                  for r, g, b in zip(ply["red"], ply["green"], ply["blue"])]
        self.assertEqual(packed, list(semantic["rgba"]))

    def test_points_have_the_class_of_their_object(self):
        ply = formats.read_ply(self.first / "semantic_map.ply")
        label_of = {item["id"]: item["label"] for item in self.objects()["objects"]}
        label_of[0] = 0
        for label, number in set(zip(ply["label"], ply["object"])):
            self.assertEqual(label, label_of[number])

    def test_points_have_the_colour_of_their_class(self):
        ply = formats.read_ply(self.first / "semantic_map.ply")
        color_of = {item["label"]: tuple(item["color_rgb"]) for item in self.objects()["classes"]}
        for label, *color in set(zip(ply["label"], ply["red"], ply["green"], ply["blue"])):
            if label != 0:
                self.assertEqual(tuple(color), color_of[label])

    def test_a_segment_has_one_object(self):
        ply = formats.read_ply(self.first / "semantic_map.ply")
        pairs = set(zip(ply["segment"], ply["object"]))
        counts = collections.Counter(segment for segment, _ in pairs if segment != 0)
        self.assertEqual(set(counts.values()), {1})

    def test_objects_agree_with_the_points(self):
        ply = formats.read_ply(self.first / "semantic_map.ply")
        root = self.objects()
        names = {item["label"]: item["name"] for item in root["classes"]}
        self.assertGreater(len(root["objects"]), 0)
        points_of = collections.defaultdict(list)
        for number, *point in zip(ply["object"], ply["x"], ply["y"], ply["z"]):
            points_of[number].append(point)
        self.assertEqual({item["id"] for item in root["objects"]}, set(points_of) - {0})
        for item in root["objects"]:
            with self.subTest(id=item["id"]):
                points = points_of[item["id"]]
                self.assertEqual(item["class"], names[item["label"]])
                self.assertEqual(item["num_points"], len(points))
                self.assertTrue(0 < item["confidence"] <= 1)
                self.assertTrue(0 <= item["entropy"] < 1)
                self.assertGreater(item["num_views"], 0)
                mean = [math.fsum(axis) / len(points) for axis in zip(*points)]
                for value, expected in zip(item["centroid"], mean):
                    self.assertAlmostEqual(value, expected, places=4)
                self.assertTrue(in_box(item["centroid"], item["box"], 1e-6))
                inside = sum(in_box(point, item["box"], 0.005) for point in points)
                self.assertGreaterEqual(inside, 0.9 * len(points))

    def test_units_and_frame_are_named(self):
        root = self.objects()
        self.assertIn("metre", json.dumps(root["units"]))
        self.assertIn("camera", root["frame"])

    def test_pictures_are_whole(self):
        for name in harness.PICTURES:
            width, height = formats.read_png_size(self.first / name)
            self.assertGreater(width, height)

    def test_a_second_sequential_run_writes_the_same_bytes(self):
        self.assert_success(self.map(*SEQUENTIAL))
        for name in MAP_FILES:
            self.assertTrue((self.first / name).read_bytes() == (self.output / name).read_bytes(),
                            f"{name} differs")

    def test_the_report_of_a_second_run_differs_in_measured_times_only(self):
        self.assert_success(self.map(*SEQUENTIAL))
        pages = [(folder / "report.html").read_text() for folder in (self.first, self.output)]
        bare = [harness.without_measured(page) for page in pages]
        self.assertTrue(bare[0] == bare[1], "the reports differ")
        self.assertLess(len(bare[0]), len(pages[0]))

    def test_the_report_says_how_good_the_trajectory_is(self):
        page = (self.first / "report.html").read_text()
        self.assertRegex(page, r"ATE, root mean square</th><td>\d+\.\d mm")
        self.assertIn(f"{NUM_FRAMES} / {NUM_FRAMES}", page)
        self.assertLess(len(page), 15_000_000)

    def test_geometry_is_the_same_without_semantics(self):
        result = self.map("--sequential", "--no-semantics", associations="-")
        self.assert_success(result)
        self.assertEqual(sorted(path.name for path in self.output.iterdir()), FILES)
        for name in NO_DETECTOR_FILES:
            self.assertTrue((self.first / name).read_bytes() == (self.output / name).read_bytes(),
                            f"{name} differs")
        self.assertEqual(json.loads((self.output / "objects.json").read_text())["objects"], [])

    def test_the_objects_are_as_their_schema_says(self):
        schema = json.loads((harness.SOURCE / "docs/objects.schema.json").read_text())
        root = self.objects()
        self.assertGreater(len(root["objects"]), 0)
        self.assertEqual(schema_faults(root, schema, schema["$defs"]), [])
        root["objects"][0]["box"]["size"] = [1, 2]
        self.assertEqual(schema_faults(root, schema, schema["$defs"]),
                         ["/objects/0/box/size: 2 items"])

    def test_objects_stand_on_segments_of_the_map(self):
        root = self.objects()
        segments = set(formats.read_ply(self.first / "semantic_map.ply")["segment"])
        ids = {item["id"] for item in root["objects"]}
        supports = [item["supported_by"] for item in root["objects"]]
        self.assertTrue(any(support["segment"] for support in supports))
        for support in supports:
            self.assertIn(support["segment"], segments | {0})
            self.assertIn(support["object"], ids | {0})

    def test_the_example_reader_lists_every_object(self):
        reader = harness.SOURCE / "Examples/python/read_objects.py"
        listed = subprocess.run([sys.executable, reader, self.first / "objects.json"],
                                capture_output=True, text=True, check=False)
        self.assertEqual((listed.returncode, listed.stderr), (0, ""))
        rows = [line.split() for line in listed.stdout.splitlines()[1:]]
        self.assertEqual([int(row[0]) for row in rows],
                         [item["id"] for item in self.objects()["objects"]])
        missing = subprocess.run([sys.executable, reader, self.first / "nothing.json"],
                                 capture_output=True, text=True, check=False)
        self.assertEqual(missing.returncode, 1)
        self.assertRegex(missing.stderr, r"^read_objects\.py: .*nothing\.json.*\n$")

    def test_only_classes_of_interest_are_in_the_map(self):
        name = self.objects()["objects"][0]["class"]
        result = self.map("--detections", CLIP / "detections", "--classes", name)
        self.assert_success(result)
        root = json.loads((self.output / "objects.json").read_text())
        self.assertEqual([item["name"] for item in root["classes"]], [name])
        self.assertEqual({item["class"] for item in root["objects"]}, {name})
        labels = set(formats.read_ply(self.output / "semantic_map.ply")["label"])
        self.assertLessEqual(labels, {0, root["classes"][0]["label"]})


TYPES = {"object": dict, "array": list, "string": str, "number": (int, float), "integer": int}


def schema_faults(value, schema, definitions, where=""):
    """What breaks the keywords that the schema uses."""
    if "$ref" in schema:
        schema = definitions[schema["$ref"].rsplit("/", 1)[1]]
    if "type" in schema and not isinstance(value, TYPES[schema["type"]]):
        return [f"{where}: {value!r}"]
    faults = []
    if "const" in schema and value != schema["const"]:
        faults.append(f"{where}: {value!r}")
    if "minimum" in schema and value < schema["minimum"]:
        faults.append(f"{where}: {value}")
    if "maximum" in schema and value > schema["maximum"]:
        faults.append(f"{where}: {value}")
    if "minItems" in schema and not schema["minItems"] <= len(value) <= schema["maxItems"]:
        faults.append(f"{where}: {len(value)} items")
    faults += [f"{where}: no {name}" for name in schema.get("required", []) if name not in value]
    for name, part in schema.get("properties", {}).items():
        if name in value:
            faults += schema_faults(value[name], part, definitions, f"{where}/{name}")
    if "items" in schema:
        for i, item in enumerate(value):
            faults += schema_faults(item, schema["items"], definitions, f"{where}/{i}")
    return faults


def in_box(point, box, tolerance):
    """Rotates the difference to the centre by the conjugate of the quaternion."""
    x, y, z, w = box["rotation_xyzw"]
    d = [a - b for a, b in zip(point, box["center"])]
    columns = [(1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)),
               (2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)),
               (2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y))]
    local = [sum(map(lambda a, b: a * b, column, d)) for column in columns]
    return all(abs(a) <= size / 2 + tolerance
               for a, size in itertools.zip_longest(local, box["size"]))


if __name__ == "__main__":
    unittest.main()
