#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the semslam authors
# SPDX-License-Identifier: BSD-3-Clause
"""Finds anchors by k-means over the boxes of a folder that render_data.py wrote, with 1 - IoU as the
distance (Redmon and Farhadi 2017), and writes them into a cfg.

    anchors.py DATA CFG
"""
import argparse

import numpy as np

import darknet
from dataset import Desks


def shape_overlaps(sizes, anchors):
    inner = np.minimum(sizes[:, None], anchors).prod(-1)
    return inner / (sizes.prod(1)[:, None] + anchors.prod(1) - inner)


def k_means(sizes, count):
    order = np.argsort(sizes.prod(1))
    anchors = sizes[order[((np.arange(count) + 0.5) * len(sizes) / count).astype(int)]]
    for _ in range(100):
        nearest = shape_overlaps(sizes, anchors).argmax(1)
        moved = np.array([np.median(sizes[nearest == i], 0) for i in range(count)])
        if np.allclose(moved, anchors):
            break
        anchors = moved
    return anchors[np.argsort(anchors.prod(1))]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("data")
    parser.add_argument("cfg")
    arguments = parser.parse_args()
    network = darknet.Network(arguments.cfg)
    # As the network will see them: cropped and scaled.
    desks = Desks(arguments.data, network.width, network.height, augment=True)
    boxes = np.concatenate([desks[i][1].numpy() for i in range(len(desks))])
    sizes = boxes[boxes[:, 5] == 0, 3:5] * [network.width, network.height]
    anchors = k_means(sizes, sum(len(head.anchors) for head in network.heads))
    darknet.replace_anchors(arguments.cfg, anchors)
    overlaps = shape_overlaps(sizes, anchors).max(1)
    print(f"{len(sizes)} boxes, anchors {np.round(anchors).astype(int).tolist()}, "
          f"mean overlap with the best {overlaps.mean():.3f}")


if __name__ == "__main__":
    main()
