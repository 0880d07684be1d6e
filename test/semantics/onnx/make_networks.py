#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the semslam authors
# SPDX-License-Identifier: BSD-3-Clause
"""Makes the networks of onnx_detector_test.cc, with PyTorch: whatever they see, they say the same of
64 x 64 pixels, in the forms of YOLOv5's and YOLOv8's exports. Two classes.

    make_networks.py            writes beside itself
"""
import pathlib

import torch

FOLDER = pathlib.Path(__file__).resolve().parent
# Centre x, y, width, height, objectness, scores of the classes. The second overlaps the first.
BOXES = torch.tensor([[32., 32., 20., 10., 0.8, 0.25, 1.0],
                      [33., 32., 20., 10., 0.6, 0.0, 1.0],
                      [10., 20., 8., 8., 0.5, 1.0, 0.0],
                      [50., 50., 8., 8., 0.1, 1.0, 1.0]])


class Fixed(torch.nn.Module):

    def __init__(self, output):
        super().__init__()
        self.average = torch.nn.AvgPool2d(64)
        self.values = torch.nn.Conv2d(3, output.numel(), 1)
        self.values.weight.data.zero_()  # The picture takes part, but has no say.
        self.values.bias.data = output.flatten()
        self.shape = (1, *output.shape)

    def forward(self, x):
        return self.values(self.average(x)).view(self.shape)


def main():
    in_lines = torch.cat([BOXES[:, :4], BOXES[:, 4:5] * BOXES[:, 5:]], 1)
    for name, output in [("yolov5", BOXES), ("yolov8", in_lines.T.contiguous())]:
        torch.onnx.export(Fixed(output), torch.zeros(1, 3, 64, 64), str(FOLDER / f"{name}.onnx"),
                          opset_version=12)


if __name__ == "__main__":
    main()
