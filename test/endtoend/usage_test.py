# SPDX-FileCopyrightText: 2026 the semslam authors
# SPDX-License-Identifier: BSD-3-Clause
"""The command lines of the programs."""
import unittest

from harness import BIN, CLIP, NUM_FRAMES, VOCABULARY, EndToEndTest, run

PROGRAMS = ["rgbd_tum", "render_clip", "evaluate_trajectory", "evaluate_map",
            "evaluate_detector", "evaluate_segmentation", "segment_cloud", "map_info", "benchmark_slam",
            "train_vocabulary"]
if (BIN / "rgbd_openni2").exists():  # Only where OpenNI2 is installed.
    PROGRAMS.append("rgbd_openni2")
if (BIN / "view_map").exists():  # Only where the viewer's packages are installed.
    PROGRAMS.append("view_map")
OPTIONS = ["--output", "--network", "--detections", "--save-detections", "--classes", "--score",
           "--drop-late", "--no-semantics", "--sequential", "--realtime", "--load-map", "--save-map",
           "--localization", "--viewer", "--viewer-stays", "--help", "--version"]


class UsageTest(EndToEndTest):

    def assert_usage_error(self, result, program, *words):
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertEqual(result.stdout, "")
        self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
        self.assertTrue(result.stderr.startswith(program + ": "), result.stderr)
        for word in words:
            self.assertIn(word, result.stderr)

    def test_help_names_all_options_and_exit_codes(self):
        result = run("rgbd_tum", "--help")
        self.assert_success(result)
        self.assertEqual(result.stderr, "")
        for word in ["VOCABULARY", "SETTINGS", "SEQUENCE", "ASSOCIATIONS", "Exit code", *OPTIONS]:
            self.assertIn(word, result.stdout)

    def test_every_program_has_help_and_version(self):
        for program in PROGRAMS:
            with self.subTest(program):
                for option, pattern in [("--help", "Usage"), ("--version", r"\d+\.\d+\.\d+")]:
                    result = run(program, option)
                    self.assert_success(result)
                    self.assertEqual(result.stderr, "")
                    self.assertRegex(result.stdout, pattern)

    def test_no_arguments_is_an_error_of_one_line(self):
        for program in PROGRAMS:
            with self.subTest(program):
                self.assert_usage_error(run(program), program, "required", "--help")

    def test_wrong_arguments_are_an_error_of_one_line(self):
        four = [VOCABULARY, CLIP / "settings.yaml", CLIP, "-"]
        for arguments, word in [
                (four[:3], "ASSOCIATIONS"),
                ([*four, "fifth"], "fifth"),
                ([*four, "--frobnicate"], "--frobnicate"),
                ([*four, "--output"], "--output"),
                ([*four, "--network", "a.cfg", "a.weights"], "--network"),
                ([*four, "--score", "high"], "high"),
                ([*four, "--score", "1.5"], "1.5"),
                ([*four, "--score", "nan"], "nan"),
                ([*four, "--realtime", "--sequential"], "--sequential"),
                ([*four, "--no-semantics", "--detections", "d"], "--detections"),
        ]:
            with self.subTest(word=word):
                self.assert_usage_error(run("rgbd_tum", *arguments), "rgbd_tum", word, "--help")

    @unittest.skipIf((BIN / "view_map").exists(), "built with a viewer")
    def test_without_the_viewer_its_options_are_an_error_of_one_line(self):
        for option in ["--viewer", "--viewer-stays"]:
            with self.subTest(option):
                self.assert_refused(self.map(option), "built without it", "libglfw3-dev")

    def test_saved_detections_need_a_detector_and_a_folder_of_their_own(self):
        four = [VOCABULARY, CLIP / "settings.yaml", CLIP, CLIP / "associations.txt"]
        for arguments, word in [
                (["--save-detections"], "--network"),
                (["--save-detections", "--detections", CLIP / "detections", "--output", CLIP],
                 "overwritten"),
        ]:
            with self.subTest(word=word):
                self.assert_usage_error(run("rgbd_tum", *four, *arguments), "rgbd_tum", word)

    def test_render_clip_refuses_what_it_cannot_render(self):
        for arguments, word in [
                (["castle", self.output], "castle"),
                (["desk", self.output, "--frames", "0"], "frame"),
                (["desk", self.output, "--frames", "many"], "many"),
                (["desk", self.output, "--camera", "pinhole"], "pinhole"),
                (["desk", CLIP / "rgb.txt" / "below"], "rgb.txt"),
        ]:
            with self.subTest(word=word):
                self.assert_usage_error(run("render_clip", *arguments), "render_clip", word)
                self.assert_no_files()

    def test_evaluate_trajectory_refuses_what_is_no_trajectory(self):
        truth = CLIP / "groundtruth.txt"
        short = self.folder / "short.txt"
        short.write_text("1.0 0 0 0 0 0 0\n")
        other_time = self.folder / "other_time.txt"
        other_time.write_text("1.0 0 0 0 0 0 0 1\n")
        for path, word in [(self.folder / "missing.txt", "missing.txt"), (short, "short.txt:1"),
                           (CLIP, "clip"), (other_time, "true pose")]:
            with self.subTest(path=path):
                result = run("evaluate_trajectory", truth, path)
                self.assert_usage_error(result, "evaluate_trajectory", word)

    def test_evaluate_trajectory_finds_no_error_in_the_truth(self):
        truth = CLIP / "groundtruth.txt"
        result = run("evaluate_trajectory", truth, truth)
        self.assert_success(result)
        self.assertIn(f"{NUM_FRAMES} of {NUM_FRAMES}", result.stdout)
        self.assertIn("rmse 0.0000 m", result.stdout)


if __name__ == "__main__":
    unittest.main()
