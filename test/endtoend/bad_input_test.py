# SPDX-FileCopyrightText: 2026 the semslam authors
# SPDX-License-Identifier: BSD-3-Clause
"""rgbd_tum with files that are missing, cut short or wrong: one line says so, no file is left."""
import re
import resource
import shutil
import signal
import subprocess
import unittest

import formats
from harness import CLIP, FILES, VOCABULARY, EndToEndTest, complaints, images


class WrongFileTest(EndToEndTest):
    """An image where another file belongs: its bytes must not reach the terminal."""

    def test_an_image_as_any_other_file_is_refused_in_printable_text(self):
        image = images(CLIP, "rgb")[0]
        cfg = self.folder / "some.cfg"
        cfg.write_text("[net]\n")
        for result in [self.map(vocabulary=image), self.map(settings=image),
                       self.map(associations=image), self.map("--network", image, image, image),
                       self.map("--network", cfg, image, image)]:
            self.assert_refused(result, image.name)
            self.assertTrue(result.stderr.rstrip("\n").isprintable(), repr(result.stderr))


class VocabularyTest(EndToEndTest):

    def refuse(self, content, *words):
        path = self.folder / "broken.voc"
        path.write_bytes(content)
        self.assert_refused(self.map(vocabulary=path), "broken.voc", *words)

    def test_a_missing_vocabulary_is_refused(self):
        self.assert_refused(self.map(vocabulary=self.folder / "no.voc"), "no.voc")

    def test_a_folder_as_vocabulary_is_refused(self):
        self.assert_refused(self.map(vocabulary=self.folder), str(self.folder))

    def test_a_truncated_vocabulary_is_refused(self):
        content = VOCABULARY.read_bytes()
        for size in [0, 5, 40, 64, len(content) // 2, len(content) - 1]:
            with self.subTest(size=size):
                self.refuse(content[:size])

    def test_a_vocabulary_with_one_changed_byte_is_refused(self):
        content = bytearray(VOCABULARY.read_bytes())
        content[len(content) // 2] ^= 1
        self.refuse(bytes(content), "checksum")

    def test_another_file_as_vocabulary_is_refused(self):
        self.refuse(images(CLIP, "rgb")[0].read_bytes())
        self.refuse((CLIP / "settings.yaml").read_bytes())

    def test_a_truncated_text_vocabulary_is_refused(self):
        text = "10 5 0 0\n" + "".join(f"0 1 {'7 ' * 32}0.5\n" for _ in range(10))
        self.refuse(text[:-30].encode(), ":11:")


class SettingsTest(EndToEndTest):

    def refuse(self, pattern, replacement, *words):
        path = self.folder / "broken.yaml"
        text = (CLIP / "settings.yaml").read_text()
        changed = re.sub(pattern, replacement, text, flags=re.MULTILINE)
        self.assertNotEqual(text, changed)
        path.write_text(changed)
        self.assert_refused(self.map(settings=path), "broken.yaml", *words)

    def test_missing_settings_are_refused(self):
        self.assert_refused(self.map(settings=self.folder / "no.yaml"), "no.yaml")

    def test_settings_without_a_key_are_refused(self):
        self.refuse(r"^Camera.fx:.*\n", "", "Camera.fx", "missing")

    def test_settings_with_a_text_where_a_number_belongs_are_refused(self):
        self.refuse(r"^Camera.fy:.*$", "Camera.fy: wide", "Camera.fy", "number", "wide")
        self.refuse(r"^Camera.width:.*$", "Camera.width: 640.5", "Camera.width", "integer", "640.5")
        self.refuse(r"^Camera.cx:.*$", "Camera.cx: nan", "Camera.cx", "nan")

    def test_settings_with_a_negative_focal_length_are_refused(self):
        self.refuse(r"^Camera.fx:.*$", "Camera.fx: -517.3", "Camera.fx", "> 0", "-517.3")

    def test_empty_settings_are_refused(self):
        self.refuse(r"(?s)\A.*\Z", "", "line 1", "%YAML")

    def test_other_files_as_settings_are_refused(self):
        self.assert_refused(self.map(settings=CLIP / "rgb.txt"), "line 1", "%YAML")
        self.assert_refused(self.map(settings=CLIP), "folder")


class AssociationsTest(EndToEndTest):

    def refuse(self, line, *words):
        path = self.folder / "broken.txt"
        lines = (CLIP / "associations.txt").read_text().splitlines()
        lines[2] = line(lines[2].split())
        path.write_text("\n".join(lines) + "\n")
        self.assert_refused(self.map(associations=path), "broken.txt:3", *words)

    def test_a_line_cut_short_is_refused(self):
        self.refuse(lambda fields: " ".join(fields[:3]), "expected", "3")

    def test_a_time_that_is_no_number_is_refused(self):
        self.refuse(lambda fields: " ".join(["noon", *fields[1:]]), "time", "noon")
        self.refuse(lambda fields: " ".join(["nan", *fields[1:]]), "time", "nan")

    def test_an_image_that_is_not_there_is_refused(self):
        self.refuse(lambda fields: " ".join([*fields[:3], "depth/none.png"]), "depth/none.png")

    def test_a_missing_file_is_refused(self):
        self.assert_refused(self.map(associations=self.folder / "no.txt"), "no.txt")

    def test_an_empty_sequence_is_refused(self):
        for content in ["", "\n\n", "# only a comment\n"]:
            path = self.folder / "empty.txt"
            path.write_text(content)
            self.assert_refused(self.map(associations=path), "empty.txt", "none")

    def test_a_missing_sequence_is_refused(self):
        missing = self.folder / "no_clip"
        result = self.map(clip=missing, settings=CLIP / "settings.yaml", associations="-")
        self.assert_refused(result, "no_clip", "folder")

    def test_a_file_as_sequence_is_refused(self):
        result = self.map(clip=CLIP / "rgb.txt", settings=CLIP / "settings.yaml", associations="-")
        self.assert_refused(result, "rgb.txt", "folder", "file")

    def test_a_sequence_without_lists_is_refused_where_times_are_to_associate(self):
        clip = self.copy_clip()
        (clip / "depth.txt").unlink()
        self.assert_refused(self.map(clip=clip, associations="-"), "depth.txt")

    def test_lists_whose_times_never_meet_are_refused(self):
        clip = self.copy_clip()
        depth = (clip / "depth.txt").read_text().splitlines()
        shifted = [line if line.startswith("#") else "9" + line for line in depth]
        (clip / "depth.txt").write_text("\n".join(shifted) + "\n")
        self.assert_refused(self.map(clip=clip, associations="-"), str(clip))


class ImagesTest(EndToEndTest):

    def test_a_broken_frame_is_skipped_counted_and_named(self):
        def truncate(path):
            self.edit(path, lambda content: content[:len(content) // 2])

        def flip(path):
            self.edit(path, lambda content: content[:5000] + b"\0\1\2\3" + content[5004:])

        def replace(*arguments):
            def write(path):
                path.unlink()
                formats.write_png(path, *arguments)
            return write

        clip = self.copy_clip()
        # Six broken frames, far more than 5 %: that the run is done, not that it was good.
        faults = [("rgb", truncate, "cut short"), ("depth", flip, "damaged"),
                  ("depth", replace(640, 480, 8, 1), "8-bit"),
                  ("rgb", replace(320, 240, 8, 3), "320x240"),
                  ("depth", replace(320, 240, 16, 1), "320x240"),
                  ("depth", lambda path: self.edit(path, lambda _: b""), "empty")]
        broken = []
        for i, (kind, damage, _) in enumerate(faults):
            broken.append(images(clip, kind)[3 + 4 * i])
            damage(broken[-1])
        result = self.map("--no-semantics", clip=clip)
        self.assertEqual(result.returncode, 2, result.stderr)
        lines = complaints(result)
        self.assertEqual(len(lines), len(faults), result.stderr)
        for line, path, (_, _, word) in zip(lines, broken, faults):
            self.assertIn(str(path), line)
            self.assertIn(word, line)
        self.assertIn("24 tracked, 0 lost, 6 unreadable", result.stdout)
        self.assertEqual(sorted(path.name for path in self.output.iterdir()), FILES)
        poses = formats.read_trajectory(self.output / "CameraTrajectory.txt")
        self.assertEqual(len(poses), 24)

    def test_one_unreadable_frame_is_no_failure(self):
        clip = self.copy_clip()
        self.edit(images(clip, "rgb")[10], lambda content: content[:1000])
        result = self.map("--no-semantics", clip=clip)
        self.assert_success(result)
        self.assertIn("29 tracked, 0 lost, 1 unreadable", result.stdout)

    def test_the_first_frame_may_be_unreadable(self):
        clip = self.copy_clip(num_frames=22)
        self.edit(images(clip, "depth")[0], lambda content: content[:1000])
        result = self.map("--no-semantics", clip=clip)
        self.assert_success(result)
        self.assertIn("21 tracked, 0 lost, 1 unreadable", result.stdout)

    def test_a_sequence_of_which_no_frame_is_readable_is_refused(self):
        clip = self.copy_clip(num_frames=3)
        for path in images(clip, "depth"):
            self.edit(path, lambda content: content[:1000])
        result = self.map("--no-semantics", clip=clip)
        self.assertEqual(result.returncode, 1)
        *skipped, last = complaints(result)
        self.assertEqual(len(skipped), 3)
        self.assertIn(str(clip), last)
        self.assertIn("no frame", last)
        self.assert_no_files()


class OutputTest(EndToEndTest):

    def test_an_output_folder_below_a_file_is_refused(self):
        (self.folder / "file").write_text("")
        result = self.map(output=self.folder / "file" / "result")
        self.assert_refused(result, str(self.folder / "file"))

    def test_a_file_as_output_folder_is_refused(self):
        (self.folder / "file").write_text("kept")
        self.assert_refused(self.map(output=self.folder / "file"), str(self.folder / "file"))
        self.assertEqual((self.folder / "file").read_text(), "kept")

    def test_an_output_folder_that_cannot_be_written_is_refused_before_the_run(self):
        # Nobody, not even root, makes files there.
        self.assert_refused(self.map(output="/proc/self"), "/proc/self")

    def test_a_disk_that_is_full_is_one_line_and_no_half_file(self):
        # A limit of the size of a file stands for the disk: the system refuses to write just so.
        limit = 20_000

        def limit_files():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))

        result = self.map("--no-semantics", clip=self.copy_clip(num_frames=5),
                          preexec_fn=limit_files)
        self.assert_disk_error(result, "global_color.pcd")
        self.assertTrue((self.output / "CameraTrajectory.txt").is_file())

    def test_a_full_file_system_is_one_line_and_no_half_file(self):
        self.output.mkdir()
        mount = shutil.which("mount")
        if not mount or subprocess.run([mount, "-t", "tmpfs", "-o", "size=64k", "none",
                                        self.output], capture_output=True, check=False).returncode:
            self.skipTest("no right to mount a small file system")
        self.addCleanup(subprocess.run, ["umount", self.output], check=True)
        self.assert_disk_error(self.map("--no-semantics", clip=self.copy_clip(num_frames=5)),
                               "No space left")

    def assert_disk_error(self, result, word):
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertEqual(len(complaints(result)), 1, result.stderr)
        self.assertIn(str(self.output), result.stderr)
        self.assertIn(word, result.stderr)
        left = {path.name for path in self.output.iterdir()}
        self.assertLessEqual(left, set(FILES))
        for name in left & {"CameraTrajectory.txt", "KeyFrameTrajectory.txt"}:
            self.assertGreater(len(formats.read_trajectory(self.output / name)), 0)
        for name in (name for name in left if name.endswith(".pcd")):
            formats.read_pcd(self.output / name)
        for name in (name for name in left if name.endswith(".png")):
            formats.read_png_size(self.output / name)


if __name__ == "__main__":
    unittest.main()
