# SPDX-FileCopyrightText: 2026 the semslam authors
# SPDX-License-Identifier: BSD-3-Clause
"""view_map: its command line, and pictures without a window."""
import os
import shutil
import struct
import unittest
import zlib

import harness
from harness import CLIP, EndToEndTest, run


def read_png(path):
    """Rows of red, green, blue of a PNG file with 8 bits a channel."""
    data = path.read_bytes()
    width, height = struct.unpack(">II", data[16:24])
    position, packed = 8, b""
    while position < len(data):
        size, kind = struct.unpack(">I4s", data[position:position + 8])
        if kind == b"IDAT":
            packed += data[position + 8:position + 8 + size]
        position += 12 + size
    raw, step = zlib.decompress(packed), 3 * width
    rows, before = [], bytearray(step)
    for y in range(height):
        method, row = raw[y * (step + 1)], bytearray(raw[y * (step + 1) + 1:(y + 1) * (step + 1)])
        for i in range(step):
            left = row[i - 3] if i >= 3 else 0
            corner = before[i - 3] if i >= 3 else 0
            guess = left + before[i] - corner
            nearest = min((abs(guess - left), 0, left), (abs(guess - before[i]), 1, before[i]),
                          (abs(guess - corner), 2, corner))[2]
            row[i] = (row[i] + [0, left, before[i], (left + before[i]) // 2, nearest][method]) & 255
        rows.append(bytes(row))
        before = row
    return rows


def colors(rows):
    return {row[i:i + 3] for row in rows for i in range(0, len(row), 3)}


def can_draw():
    result = run("view_map", harness.WORK / "view_map" / "result", "--picture",
                 harness.WORK / "view_map" / "probe.png", "--size", "32x32")
    return "no OpenGL" not in result.stderr


class ViewMapTest(EndToEndTest):

    @classmethod
    def setUpClass(cls):
        work = harness.WORK / "view_map"
        cls.result, cls.saved = work / "result", work / "saved.map"
        mapped = run("rgbd_tum", harness.VOCABULARY, CLIP / "settings.yaml", CLIP,
                     CLIP / "associations.txt", "--output", cls.result, "--sequential",
                     "--detections", CLIP / "detections", "--save-map", cls.saved)
        assert mapped.returncode == 0, mapped.stderr
        cls.can_draw = can_draw()
        assert cls.can_draw or "SEMSLAM_REQUIRE_VIEWER" not in os.environ, "nothing can be drawn"

    def draw(self, shown, *options, size="240x180"):
        if not self.can_draw:
            self.skipTest("no OpenGL here")
        picture = self.folder / "picture.png"
        result = run("view_map", shown, "--picture", picture, "--size", size, *options)
        self.assert_success(result)
        self.assertEqual(result.stdout + result.stderr, "")
        return read_png(picture)

    def assert_one_complaint(self, result, *words):
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
        self.assertTrue(result.stderr.startswith("view_map: "), result.stderr)
        for word in words:
            self.assertIn(str(word), result.stderr)

    def test_wrong_arguments_are_an_error_of_one_line(self):
        for arguments, word in [([], "MAP"), (["--from", "below"], "below"),
                                (["--color", "taste"], "taste"), (["--size", "big"], "big"),
                                (["--size", "10x10"], "10"), (["--size", "99999x100"], "99999"),
                                (["--eye-dome", "maybe"], "maybe"), (["--frobnicate"], "frob")]:
            shown = [self.result] if arguments else []
            with self.subTest(arguments):
                self.assert_one_complaint(
                    run("view_map", *shown, "--picture", self.folder / "a.png", *arguments), word)

    def test_what_is_no_map_is_an_error_of_one_line(self):
        empty, text = self.folder / "empty", self.folder / "text.txt"
        empty.mkdir()
        text.write_text("no cloud\n")
        (self.folder / "cut.ply").write_bytes(
            (self.result / "semantic_map.ply").read_bytes()[:5000])
        (self.folder / "cut.map").write_bytes(self.saved.read_bytes()[:5000])
        for shown, words in [(self.folder / "nowhere", ["nowhere", "not found"]),
                             (empty, ["empty", "expected results"]),
                             (text, ["text.txt", "expected a PCD or PLY file"]),
                             (self.folder / "cut.ply", ["cut.ply", "cut short"]),
                             (self.folder / "cut.map", ["cut.map", "expected"])]:
            with self.subTest(shown.name):
                self.assert_one_complaint(
                    run("view_map", shown, "--picture", self.folder / "a.png"), *words)
                self.assertFalse((self.folder / "a.png").exists())

    def test_files_that_do_not_belong_together_are_refused(self):
        mixed = self.folder / "mixed"
        shutil.copytree(self.result, mixed)
        shutil.copy(self.result / "semantic_map.ply", mixed / "semantic_map.ply")
        header, body = (mixed / "semantic_map.ply").read_bytes().split(b"end_header\n", 1)
        lines = header.split(b"\n")
        lines = [b"element vertex 100" if line.startswith(b"element vertex") else line
                 for line in lines]
        (mixed / "semantic_map.ply").write_bytes(b"\n".join(lines) + b"end_header\n" + body)
        self.assert_one_complaint(run("view_map", mixed, "--picture", self.folder / "a.png"),
                                  "global_color.pcd", "expected 100 points")

    def test_a_folder_a_map_and_clouds_can_be_seen(self):
        for shown in [self.result, self.saved, self.result / "global_color.pcd",
                      self.result / "semantic_map.ply", self.result / "segmentation.pcd"]:
            with self.subTest(shown.name):
                self.assertGreater(len(colors(self.draw(shown))), 300)

    def test_a_saved_map_looks_as_its_folder_does(self):
        folder, saved = self.draw(self.result), self.draw(self.saved)
        difference = sum(abs(a - b) for x, y in zip(folder, saved) for a, b in zip(x, y))
        self.assertLess(difference / (240 * 180 * 3), 12)

    def test_each_switch_changes_the_picture(self):
        plain = self.draw(self.result)
        for options in [["--color", "classes"], ["--color", "segments"], ["--color", "height"],
                        ["--from", "top"], ["--from", "left"], ["--eye-dome", "off"],
                        ["--overlay", "off"]]:
            with self.subTest(options):
                self.assertNotEqual(self.draw(self.result, *options), plain)

    def test_a_picture_has_the_size_that_was_asked_for(self):
        rows = self.draw(self.result, size="100x60")
        self.assertEqual((len(rows[0]) // 3, len(rows)), (100, 60))

    def test_without_a_screen_a_window_is_an_error_of_one_line(self):
        environment = {name: value for name, value in os.environ.items()
                       if name not in ("DISPLAY", "WAYLAND_DISPLAY")}
        self.assert_one_complaint(run("view_map", self.result, env=environment), "no window")


if __name__ == "__main__":
    unittest.main()
