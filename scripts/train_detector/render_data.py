#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the semslam authors
# SPDX-License-Identifier: BSD-3-Clause
"""Renders pictures of random desks and writes the boxes of what shows in them.

    render_data.py OUT --seeds 1000:1300 [--frames 8] [--render-clip PROGRAM]

gives OUT/SEED_FRAME.jpg and beside it OUT/SEED_FRAME.txt with a line for each object:

    class cx cy width height hard        relative to the picture's size, as in YOLO's files

hard is 1 for what shows too little to be asked for: neither learned nor held against the network.
Odd seeds see the desk from where the random scene's camera goes, even ones from farther around it.
Seeds that are there already are passed over, so a stopped run goes on.
"""
import argparse
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import cv2
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
PATH_SECONDS = 13.0  # Of the random scene's camera path.

# Boxes are drawn as people draw them: around the mouse without its cable. Thinner parts, in metres,
# do not count.
MIN_THICKNESS = 0.007
# What counts as hard: fewer visible pixels, a thinner box, or a smaller part of the area that the
# whole object would fill if nothing stood before it.
# All of this is as in include/semslam/eval/true_boxes.h.
MIN_PIXELS = 150
MIN_SIDE = 8
MIN_VISIBLE_PART = 0.12

# Nearer, higher and farther to the sides than the scene's own camera.
WIDE_CAMERA = """camera:
  seconds_per_waypoint: 1.1
  waypoints:
    - repeat: 12
      eye:
        - [$sweep * 1.5 * sin($i * 30) - 0.25, $sweep * 1.5 * sin($i * 30) + 0.25]
        - [$front - 0.75, $front - 0.1]
        - [$desk_height + 0.25, $desk_height + 1.0]
      target:
        - [0.6 * $sweep * sin($i * 30) - 0.3, 0.6 * $sweep * sin($i * 30) + 0.3]
        - [-0.25, 0.2]
        - [$desk_height - 0.05, $desk_height + 0.3]
"""


def write_wide_scene(path):
    text = (ROOT / "config/scenes/random.yaml").read_text()
    replaced, count = re.subn(r"^camera:\n(?:[ #].*\n|\n)*", WIDE_CAMERA, text, flags=re.MULTILINE)
    if count != 1:
        sys.exit("config/scenes/random.yaml: expected one block `camera:`")
    path.write_text(replaced)


def read_focal_lengths(settings):
    text = settings.read_text()
    return np.array([float(re.search(rf"^Camera\.{key}: (\S+)", text, re.MULTILINE).group(1))
                     for key in ("fx", "fy")])


def rotation(quaternion):
    x, y, z, w = quaternion
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def without_thin_parts(mask, instance, pose, focal_lengths):
    centre = (np.array(instance["center"]) - pose[:3]) @ rotation(pose[3:])
    pixels = int(np.ceil(MIN_THICKNESS * focal_lengths[0] / max(centre[2], 0.1)))
    square, anchor = np.ones((pixels, pixels), np.uint8), pixels // 2
    eroded = cv2.erode(mask, square, anchor=(anchor, anchor))
    back = pixels - 1 - anchor  # Else squares of even size would shift the rest.
    return cv2.dilate(eroded, square, anchor=(back, back))


def full_area(instance, pose, focal_lengths):
    """Pixels that the object's box fills in the picture and beside it; 0 if it is not in front."""
    signs = np.array([[i & 1, i >> 1 & 1, i >> 2 & 1] for i in range(8)]) - 0.5
    corners = signs * np.array(instance["size"]) @ rotation(instance["orientation"]).T
    in_camera = (corners + instance["center"] - pose[:3]) @ rotation(pose[3:])
    if in_camera[:, 2].min() < 0.05:
        return 0.0
    points = in_camera[:, :2] / in_camera[:, 2:] * focal_lengths
    return cv2.contourArea(cv2.convexHull(points.astype(np.float32)))


def boxes_of(labels, instances, classes, pose, focal_lengths):
    height, width = labels.shape
    lines = []
    for instance in instances:
        if instance["class"] not in classes:
            continue
        mask = (labels == instance["id"]).astype(np.uint8)
        rows, columns = np.nonzero(without_thin_parts(mask, instance, pose, focal_lengths))
        if len(rows) < 20:
            continue
        left, right = columns.min(), columns.max() + 1
        top, bottom = rows.min(), rows.max() + 1
        hard = (len(rows) < MIN_PIXELS or min(right - left, bottom - top) < MIN_SIDE or
                len(rows) < MIN_VISIBLE_PART * full_area(instance, pose, focal_lengths))
        lines.append(f"{classes.index(instance['class'])} {(left + right) / 2 / width:.6f} "
                     f"{(top + bottom) / 2 / height:.6f} {(right - left) / width:.6f} "
                     f"{(bottom - top) / height:.6f} {int(hard)}\n")
    return lines


def convert(clip, out, seed, classes):
    """The clip's pictures as JPEG, its labels as boxes."""
    instances = json.loads((clip / "instances.json").read_text())["instances"]
    focal_lengths = read_focal_lengths(clip / "settings.yaml")
    poses = np.loadtxt(clip / "groundtruth.txt", comments="#", ndmin=2)[:, 1:]
    stamps = [line.split()[0] for line in (clip / "associations.txt").read_text().splitlines()]
    for index, (stamp, pose) in enumerate(zip(stamps, poses)):
        name = out / f"{seed}_{index:02d}"
        labels = cv2.imread(str(clip / "labels" / f"{stamp}.png"), cv2.IMREAD_UNCHANGED)
        picture = cv2.imread(str(clip / "rgb" / f"{stamp}.png"))
        cv2.imwrite(f"{name}.jpg", picture, [cv2.IMWRITE_JPEG_QUALITY, 93])
        lines = boxes_of(labels, instances, classes, pose, focal_lengths)
        pathlib.Path(f"{name}.txt").write_text("".join(lines))


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--seeds", required=True, help="FIRST:END, the end not included")
    parser.add_argument("--frames", type=int, default=8, help="of each desk")
    parser.add_argument("--names", type=pathlib.Path, default=ROOT / "config/detector/desk.names")
    parser.add_argument("--render-clip", type=pathlib.Path,
                        default=ROOT / "build/release/bin/render_clip")
    arguments = parser.parse_args()
    classes = arguments.names.read_text().split("\n")[:-1]
    arguments.out.mkdir(parents=True, exist_ok=True)
    first, end = map(int, arguments.seeds.split(":"))
    with tempfile.TemporaryDirectory() as folder:
        wide = pathlib.Path(folder) / "wide.yaml"
        write_wide_scene(wide)
        for seed in range(first, end):
            if (arguments.out / f"{seed}_{arguments.frames - 1:02d}.txt").exists():
                continue
            clip = pathlib.Path(folder) / "clip"
            subprocess.run([arguments.render_clip, "random" if seed % 2 else wide, clip,
                            "--seed", str(seed), "--frames", str(arguments.frames),
                            "--fps", f"{arguments.frames / PATH_SECONDS:.4f}"], check=True)
            convert(clip, arguments.out, seed, classes)
            shutil.rmtree(clip)


if __name__ == "__main__":
    main()
