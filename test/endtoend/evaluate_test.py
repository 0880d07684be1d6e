# SPDX-FileCopyrightText: 2026 the semslam authors
# SPDX-License-Identifier: BSD-3-Clause
"""The programs that measure a map and its segmentation."""
import json
import re
import shutil
import unittest

import harness
from harness import CLIP, NUM_FRAMES, SOURCE, EndToEndTest, run

TRUTH = ["groundtruth.txt", "instances.json", "surface.pcd"]
RESULT = ["CameraTrajectory.txt", "segmentation.pcd", "semantic_map.pcd", "objects.json"]
MEASURES = ["adjusted_rand_index", "over_segmentation", "under_segmentation", "boundary_recall",
            "boundary_precision", "coverage"]


class EvaluateTest(EndToEndTest):

    result = harness.WORK / "evaluated"  # Folder of one run, which no test changes.

    @classmethod
    def setUpClass(cls):
        cls.summary = run("rgbd_tum", harness.VOCABULARY, CLIP / "settings.yaml", CLIP,
                          CLIP / "associations.txt", "--output", cls.result, "--sequential",
                          "--detections", CLIP / "detections", "--save-detections")

    def assert_error(self, result, program, *words):
        """Exit code 1, and one line of error that has all the words."""
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertEqual(result.stdout, "")
        self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
        self.assertTrue(result.stderr.startswith(program + ": "), result.stderr)
        for word in words:
            self.assertIn(word, result.stderr)

    def copy(self, folder, names):
        copy = self.folder / folder.name
        shutil.rmtree(copy, ignore_errors=True)
        copy.mkdir()
        for name in names:
            shutil.copy(folder / name, copy / name)
        return copy

    def test_a_map_is_measured(self):
        self.assert_success(self.summary)
        path = self.folder / "measures.json"
        result = run("evaluate_map", CLIP, self.result, "--json", path)
        self.assert_success(result)
        self.assertEqual(result.stderr, "")
        for word in ["trajectory", "surface", "segmentation", "boundaries", "labels", "objects",
                     "keyboard", "tvmonitor"]:
            self.assertRegex(result.stdout, rf"(?m)^(\d+ )?{word}")
        measures = json.loads(path.read_text())
        self.assertEqual(measures["trajectory"]["num_pairs"], NUM_FRAMES)
        self.assertLess(measures["trajectory"]["ate_rmse_m"], 0.02)
        self.assertLess(measures["surface"]["error_median_m"], 0.005)
        self.assertLess(measures["surface"]["num_off_surface"],
                        0.01 * measures["surface"]["num_points"])
        self.assertGreater(measures["segmentation"]["adjusted_rand_index"], 0.5)
        self.assertGreater(measures["labels"]["accuracy"], 0.8)
        self.assertEqual([item["min_iou"] for item in measures["objects"]], [0.25, 0.5])

    def test_simpler_ways_of_labelling_are_measured_too(self):
        lines = (self.result / "KeyFrameTrajectory.txt").read_text().splitlines()
        pictures = list((self.result / "detections").glob("*.jpg"))
        self.assertEqual(len(pictures), sum(not line.startswith("#") for line in lines))
        path = self.folder / "measures.json"
        result = run("evaluate_map", CLIP, self.result, "--json", path,
                     "--detections", self.result / "detections")
        self.assert_success(result)
        baselines = json.loads(path.read_text())["labels"]["baselines"]
        self.assertEqual(list(baselines), ["painted boxes", "votes by point", "votes by segment"])
        for name, measures in baselines.items():
            self.assertRegex(result.stdout, rf"(?m)^{name} +\d\.\d+ +\d\.\d+ +\d\.\d+$")
            self.assertGreater(measures["accuracy_on_objects"], 0.5, name)
        self.assertGreater(baselines["painted boxes"]["bleeding"], 0.05)
        self.assertLess(baselines["votes by segment"]["bleeding"],
                        baselines["painted boxes"]["bleeding"])

    def test_detections_of_other_classes_are_refused(self):
        other = self.folder / "other"
        shutil.copytree(self.result / "detections", other)
        (other / "classes.names").write_text("person\ncar\n")
        self.assert_error(run("evaluate_map", CLIP, self.result, "--detections", other),
                          "evaluate_map", "classes.names", "expected the classes of the result")

    def test_the_same_map_gives_the_same_bytes(self):
        for name in ["first", "second"]:
            self.assert_success(run("evaluate_map", CLIP, self.result,
                                    "--json", self.folder / f"{name}.json",
                                    "--labelled-cloud", self.folder / f"{name}.pcd"))
        for kind in ["json", "pcd"]:
            self.assertEqual((self.folder / f"first.{kind}").read_bytes(),
                             (self.folder / f"second.{kind}").read_bytes())

    def test_only_the_classes_asked_for_are_measured(self):
        path = self.folder / "measures.json"
        self.assert_success(run("evaluate_map", CLIP, self.result, "--classes", "mug,keyboard",
                                "--json", path))
        classes = json.loads(path.read_text())["labels"]["classes"]
        self.assertEqual([item["name"] for item in classes], ["mug", "keyboard"])
        self.assert_error(run("evaluate_map", CLIP, self.result, "--classes", "zebra"),
                          "evaluate_map", "zebra")

    def test_a_missing_file_is_named(self):
        clip = self.copy(CLIP, TRUTH)
        for folder, names in [(clip, TRUTH), (self.copy(self.result, RESULT), RESULT)]:
            for name in names:
                with self.subTest(name):
                    (folder / name).rename(self.folder / "aside")
                    self.assert_error(run("evaluate_map", clip, self.folder / "evaluated"),
                                      "evaluate_map", f"{folder.name}/{name}")
                    (self.folder / "aside").rename(folder / name)

    def test_a_damaged_file_is_named(self):
        clip = self.copy(CLIP, TRUTH)
        for folder, names in [(clip, TRUTH[1:]), (self.copy(self.result, RESULT), RESULT)]:
            for name in names:
                content = (folder / name).read_bytes()
                for what, damaged in [("cut", content[:len(content) * 2 // 3 - 7]),
                                      ("noise", b"\0\xff" * 99)]:
                    with self.subTest(name, what=what):
                        (folder / name).write_bytes(damaged)
                        self.assert_error(run("evaluate_map", clip, self.folder / "evaluated"),
                                          "evaluate_map", f"{folder.name}/{name}")
                (folder / name).write_bytes(content)

    def test_clouds_of_different_runs_are_refused(self):
        result = self.copy(self.result, RESULT)
        shutil.copy(CLIP / "surface.pcd", result / "semantic_map.pcd")
        self.assert_error(run("evaluate_map", CLIP, result), "evaluate_map", "semantic_map.pcd",
                          "segmentation.pcd")

    def test_a_file_that_cannot_be_written_is_named(self):
        path = CLIP / "rgb.txt" / "below.json"
        self.assert_error(run("evaluate_map", CLIP, self.result, "--json", path), "evaluate_map",
                          "below.json")

    def test_methods_are_compared_on_a_cloud_with_labels(self):
        cloud = self.folder / "map.pcd"
        self.assert_success(run("evaluate_map", CLIP, self.result, "--labelled-cloud", cloud))
        path = self.folder / "measures.json"
        result = run("evaluate_segmentation", cloud, "--json", path)
        self.assert_success(result)
        for method in ["graph", "lccp", "region-growing"]:
            self.assertRegex(result.stdout, rf"{method} +-?\d\.\d+ +\d\.\d+")
        measures = json.loads(path.read_text())
        self.assertEqual(measures["clouds"][0]["name"], "map")
        methods = measures["clouds"][0]["methods"]
        self.assertEqual([item["method"] for item in methods], ["graph", "lccp", "region-growing"])
        for item in methods:
            self.assertEqual(list(item["measures"]), MEASURES)
            self.assertGreater(item["num_segments"], 0)
        self.assertGreater(methods[0]["measures"]["adjusted_rand_index"], 0.5)

    def test_a_cloud_without_labels_gives_times_and_numbers(self):
        result = run("evaluate_segmentation", self.result / "global_color.pcd", "--methods",
                     "graph", "--pictures", self.folder / "pictures")
        self.assert_success(result)
        self.assertRegex(result.stdout, r"global_color +\d+ graph +- +- +- +- +- +- +\d+ +\d+\n")
        self.assertNotIn("lccp", result.stdout)
        self.assertEqual([path.name for path in (self.folder / "pictures").iterdir()],
                         ["global_color_graph.png"])

    def test_a_folder_gives_the_mean_of_its_clouds(self):
        for name in ["a.pcd", "b.pcd"]:
            shutil.copy(self.result / "segmentation.pcd", self.folder / name)
        result = run("evaluate_segmentation", self.folder, "--methods", "graph")
        self.assert_success(result)
        rows = [re.split(r" +", line) for line in result.stdout.splitlines()]
        self.assertEqual([row[0] for row in rows], ["cloud", "a", "b", "mean"])
        self.assertEqual(rows[1][2:8], rows[2][2:8])
        self.assertEqual(rows[3][1:7], rows[1][2:8])

    def test_clouds_that_cannot_be_read_are_named(self):
        empty = self.folder / "empty"
        empty.mkdir()
        damaged = self.folder / "damaged.pcd"
        damaged.write_bytes((self.result / "global_color.pcd").read_bytes()[:5000])
        for path, word in [(empty, "empty"), (damaged, "damaged.pcd"),
                           (self.folder / "missing.pcd", "missing.pcd"),
                           (CLIP / "rgb.txt", "rgb.txt")]:
            with self.subTest(word):
                self.assert_error(run("evaluate_segmentation", path), "evaluate_segmentation",
                                  word)

    def test_an_unknown_method_is_an_error(self):
        self.assert_error(run("evaluate_segmentation", CLIP, "--methods", "magic"),
                          "evaluate_segmentation", "magic")


class EvaluateDetectorTest(EndToEndTest):

    shipped = [SOURCE / "config" / "detector" / f"desk.{ending}"
               for ending in ("cfg", "weights", "names")]

    def evaluate(self, *arguments):
        return run("evaluate_detector", *arguments, "--network", *self.shipped, "--every", 10)

    def test_the_shipped_detector_is_measured(self):
        result = self.evaluate(CLIP)
        self.assert_success(result)
        self.assertEqual(result.stderr, "")
        for name in ["cup", "keyboard", "tvmonitor", "mouse"]:
            self.assertRegex(result.stdout, rf"(?m)^{name} +\d+ +([01]\.\d+|-)$")
        self.assertRegex(result.stdout, r"(?m)^mean +[01]\.\d+$")
        self.assertRegex(result.stdout, r"\d+ pictures, median \d+\.\d ms")

    def test_a_clip_without_truth_is_refused(self):
        clip = self.copy_clip(num_frames=2)
        for name in ["instances.json", "groundtruth.txt", "labels"]:
            (clip / name).symlink_to(CLIP / name)
        self.assert_success(self.evaluate(clip))
        for name in ["instances.json", "groundtruth.txt", "labels", "settings.yaml"]:
            with self.subTest(name):
                kept = (clip / name).rename(self.folder / "kept")
                result = self.evaluate(clip)
                self.assertEqual(result.returncode, 1)
                self.assertIn(name, result.stderr)
                kept.rename(clip / name)



if __name__ == "__main__":
    unittest.main()
