#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the semslam authors
# SPDX-License-Identifier: BSD-3-Clause
"""Writes what the trained network says in PyTorch of a few pictures, for the test that OpenCV says
the same (test/semantics/shipped_detector_test.cc).

    export_reference.py CFG WEIGHTS OUT PICTURE...

gives OUT/NAME.jpg, the picture at the size of the network's input, and OUT/NAME.txt: a line for each
box, before overlapping ones are suppressed, of min_x min_y max_x max_y in pixels and the score of
each class.
"""
import argparse
import pathlib

import cv2
import numpy as np
import torch

import darknet

LOWEST_SCORE = 0.1
JPEG_QUALITY = 88


def boxes_of(network, picture):
    pixels = np.ascontiguousarray(picture[:, :, ::-1].transpose(2, 0, 1))
    with torch.no_grad():
        rows = network.predict(torch.from_numpy(pixels)[None].float() / 255)[0].numpy()
    rows = rows[rows[:, 5:].max(1) >= LOWEST_SCORE]
    size = np.array([network.width, network.height])
    return np.concatenate([(rows[:, :2] - rows[:, 2:4] / 2) * size,
                           (rows[:, :2] + rows[:, 2:4] / 2) * size, rows[:, 5:]], 1)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("cfg", type=pathlib.Path)
    parser.add_argument("weights", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("pictures", type=pathlib.Path, nargs="+")
    arguments = parser.parse_args()
    network = darknet.Network(arguments.cfg).eval()
    darknet.read_weights(network, arguments.weights)
    arguments.out.mkdir(parents=True, exist_ok=True)
    for path in arguments.pictures:
        picture = cv2.resize(cv2.imread(str(path)), (network.width, network.height),
                             interpolation=cv2.INTER_AREA)
        stored = arguments.out / f"{path.stem}.jpg"
        cv2.imwrite(str(stored), picture, [cv2.IMWRITE_JPEG_QUALITY, JPEG_QUALITY])
        boxes = boxes_of(network, cv2.imread(str(stored)))
        np.savetxt(stored.with_suffix(".txt"), boxes, fmt="%.5f")


if __name__ == "__main__":
    main()
