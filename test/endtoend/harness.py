# SPDX-FileCopyrightText: 2026 the semslam authors
# SPDX-License-Identifier: BSD-3-Clause
"""What the end-to-end tests share: the programs, a rendered clip, and damaged copies of it.

CMake gives the places in the environment: SEMSLAM_BIN (folder of the programs), SEMSLAM_SOURCE
(root of the project) and SEMSLAM_ENDTOEND (work folder, in which setup.py renders the clip once).
"""
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

BIN = pathlib.Path(os.environ["SEMSLAM_BIN"])
SOURCE = pathlib.Path(os.environ["SEMSLAM_SOURCE"])
WORK = pathlib.Path(os.environ["SEMSLAM_ENDTOEND"])
CLIP = WORK / "clip"
VOCABULARY = SOURCE / "Vocabulary" / "orb.voc"
NUM_FRAMES = 30
TIMEOUT = 120  # Seconds, of one run; far above what it needs.

TRAJECTORIES = ["CameraTrajectory.txt", "KeyFrameTrajectory.txt"]
CLOUDS = ["global_color.pcd", "segmentation.pcd", "semantic_map.pcd", "semantic_map.ply"]
PICTURES = ["semantic_map_top.png", "semantic_map_view.png"]
MAP_FILES = sorted([*TRAJECTORIES, *CLOUDS, *PICTURES, "objects.json"])  # Of map_info too.
# A run's report holds measured times, so its bytes differ; without_measured() leaves them out.
FILES = sorted([*MAP_FILES, "report.html"])


def run(program, *arguments, **keywords):
    """Runs a program to its end; the result has returncode, stdout, stderr."""
    return subprocess.run([BIN / program, *map(str, arguments)], capture_output=True, text=True,
                          timeout=TIMEOUT, check=False, **keywords)


class EndToEndTest(unittest.TestCase):
    """A test with a folder of its own that is removed afterwards."""

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(dir=WORK))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        self.output = self.folder / "result"

    def map(self, *options, clip=CLIP, settings=None, vocabulary=VOCABULARY, associations=None,
            output=None, **keywords):
        """Runs rgbd_tum; what is not given is as it should be."""
        return run("rgbd_tum", vocabulary, settings or clip / "settings.yaml", clip,
                   associations or clip / "associations.txt", "--output", output or self.output,
                   *options, **keywords)

    def assert_success(self, result):
        self.assertEqual(result.returncode, 0, result.stderr)

    def assert_refused(self, result, *words):
        """Exit code 1, and one line of error that has all the words; no file anywhere."""
        self.assertEqual(result.returncode, 1, result.stderr)
        lines = complaints(result)
        self.assertEqual(len(lines), 1, result.stderr)
        self.assertTrue(lines[0].startswith("rgbd_tum: "), lines[0])
        for word in words:
            self.assertIn(word, lines[0])
        self.assertEqual(result.stdout, "")
        self.assert_no_files()

    def assert_no_files(self):
        left = [path.name for path in self.output.iterdir()] if self.output.is_dir() else []
        self.assertEqual(left, [])

    def copy_clip(self, num_frames=NUM_FRAMES):
        """A copy of the clip's first frames; the images are links, to be replaced, not changed."""
        copy = self.folder / "clip"
        copy.mkdir()
        for name in ["settings.yaml", "associations.txt", "rgb.txt", "depth.txt"]:
            shutil.copy(CLIP / name, copy / name)
        lines = (copy / "associations.txt").read_text().splitlines(keepends=True)
        (copy / "associations.txt").write_text("".join(lines[:num_frames]))
        for name in ["rgb", "depth"]:
            (copy / name).mkdir()
            for image in (CLIP / name).iterdir():
                (copy / name / image.name).symlink_to(image)
        return copy

    def edit(self, path, edit):
        """Replaces the content of a file, or of a link's copy, by edit(content)."""
        content = path.read_bytes()
        path.unlink()
        path.write_bytes(edit(content))


def without_measured(page):
    """A report without what was measured with a clock: one tile and one section."""
    page = re.sub(r'<div class="tile measured">.*\n', "", page)
    return re.sub(r'<section id="speed">.*?<!-- End of what was measured with a clock. -->', "",
                  page, flags=re.DOTALL)


def complaints(result):
    """The lines on standard error but for the progress, which shows on slow machines."""
    return [line for line in result.stderr.splitlines() if not re.match(r"frame \d+/", line)]


def images(clip, kind):
    """The images of a clip in the order of time; kind is rgb or depth."""
    return sorted((clip / kind).iterdir())
