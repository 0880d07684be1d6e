# SPDX-FileCopyrightText: 2026 the semslam authors
# SPDX-License-Identifier: BSD-3-Clause
"""Vocabularies from images, as text and binary; and the times of a run."""
import re
import unittest

import harness
from harness import CLIP, EndToEndTest, run


class VocabularyTest(EndToEndTest):

    def train(self, name, *options):
        out = self.folder / name
        self.assert_success(
            run("train_vocabulary", "train", out, CLIP / "rgb", "--step", "20", "--depth", "3",
                "--min-descriptors", "20", *options))
        return out

    def test_the_same_images_give_the_same_bytes_on_any_number_of_threads(self):
        one = self.train("one.voc", "--threads", "1").read_bytes()
        self.assertEqual(self.train("three.voc", "--threads", "3").read_bytes(), one)
        self.assertNotEqual(self.train("other.voc", "--seed", "2").read_bytes(), one)

    def test_text_and_binary_say_the_same(self):
        binary = self.train("first.voc")
        text = self.folder / "copy.txt"
        again = self.folder / "again.voc"
        self.assert_success(run("train_vocabulary", "convert", binary, text))
        self.assertTrue(text.read_text().startswith("10 3 0 0\n"))
        self.assert_success(run("train_vocabulary", "convert", text, again))
        self.assertEqual(again.read_bytes(), binary.read_bytes())

    def test_info_counts_the_words(self):
        text = self.folder / "words.txt"
        self.assert_success(run("train_vocabulary", "convert", self.train("words.voc"), text))
        num_leaves = sum(line.split()[1] == "1" for line in text.read_text().splitlines()[1:])
        result = run("train_vocabulary", "info", text)
        self.assert_success(result)
        self.assertIn(f"{num_leaves} words", result.stdout)

    def test_what_is_no_vocabulary_is_refused(self):
        for command in [["info"], ["convert"]]:
            result = run("train_vocabulary", *command, CLIP / "settings.yaml",
                         *([self.folder / "out.voc"] if command == ["convert"] else []))
            self.assertEqual(result.returncode, 1)
            self.assertIn("settings.yaml", result.stderr)
        self.assertFalse((self.folder / "out.voc").exists())


class BenchmarkTest(EndToEndTest):

    def test_it_tells_step_times_and_waits(self):
        result = run("benchmark_slam", harness.VOCABULARY, CLIP / "settings.yaml", CLIP,
                     CLIP / "associations.txt", "--sequential")
        self.assert_success(result)
        for step in ["features", "local map", "bundle adjustment", "all"]:
            times = re.search(rf"^  {step} +(\d+) +([0-9.]+) +([0-9.]+) +([0-9.]+)", result.stdout,
                              re.MULTILINE)
            self.assertIsNotNone(times, step)
            self.assertGreater(int(times[1]), 0)
            self.assertLessEqual(float(times[2]), float(times[4]))
        self.assertRegex(result.stdout, r"tracking asked \d+ times and waited: p99 [0-9.]+ ms")


if __name__ == "__main__":
    unittest.main()
