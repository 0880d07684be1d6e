# SPDX-FileCopyrightText: 2026 the semslam authors
# SPDX-License-Identifier: BSD-3-Clause
"""Darknet's files: the network of a .cfg in PyTorch, and its .weights. Only the layers that
config/detector/desk.cfg has: convolutional (leaky or linear), shortcut, route, upsample, yolo."""
import dataclasses
import pathlib
import re

import numpy as np
import torch
from torch import nn

VERSION = (0, 2, 0)  # From 0.2 on the number of images seen has 64 bits.


def read_sections(path):
    """[(type, {key: value})] in the order of the file."""
    sections = []
    for line in pathlib.Path(path).read_text().splitlines():
        line = line.split("#")[0].strip()
        if line.startswith("["):
            sections.append((line.strip("[]"), {}))
        elif line:
            key, value = line.split("=")
            sections[-1][1][key.strip()] = value.strip()
    return sections


def integers(text):
    return [int(item) for item in text.split(",")]


def anchor_pairs(text):
    numbers = [float(item) for item in text.split(",")]
    return list(zip(numbers[0::2], numbers[1::2]))


def replace_anchors(path, anchors):
    """Writes the anchors, pixels of the input, into every [yolo] section of a cfg."""
    text = ", ".join(f"{width:.0f},{height:.0f}" for width, height in anchors)
    old = pathlib.Path(path).read_text()
    pathlib.Path(path).write_text(re.sub(r"(?m)^anchors *=.*$", f"anchors={text}", old))


@dataclasses.dataclass
class Head:
    """What a [yolo] layer says of the layer before it."""
    stride: int    # Pixels of the input to a cell.
    anchors: list  # (width, height) in pixels of the input.
    num_classes: int


class Network(nn.Module):
    """forward: pictures (batch, 3, height, width), RGB in [0, 1] -> what goes into each [yolo]
    layer, (batch, anchors, rows, columns, 5 + classes): tx, ty, tw, th, objectness, classes."""

    def __init__(self, cfg):
        super().__init__()
        (_, net), *self.sections = read_sections(cfg)
        self.width, self.height = int(net["width"]), int(net["height"])
        self.heads, self.layers = [], nn.ModuleList()
        channels, strides = [], []  # Of each layer's output.
        for kind, values in self.sections:
            last, stride = (channels[-1], strides[-1]) if channels else (3, 1)
            layer = nn.Identity()
            if kind == "convolutional":
                layer = convolution(values, last)
                last, stride = int(values["filters"]), stride * int(values["stride"])
            elif kind == "upsample":
                layer = nn.Upsample(scale_factor=int(values["stride"]), mode="nearest")
                stride //= int(values["stride"])
            elif kind == "route":
                numbers = integers(values["layers"])
                last, stride = sum(channels[i] for i in numbers), strides[numbers[0]]
            elif kind == "yolo":
                anchors = anchor_pairs(values["anchors"])
                self.heads.append(Head(stride, [anchors[i] for i in integers(values["mask"])],
                                       int(values["classes"])))
            elif kind != "shortcut":
                raise ValueError(f"{cfg}: [{kind}]: this layer is not known here")
            self.layers.append(layer)
            channels.append(last)
            strides.append(stride)

    def forward(self, x):
        outputs, raw = [], []
        for (kind, values), layer in zip(self.sections, self.layers):
            if kind == "route":
                x = torch.cat([outputs[number] for number in integers(values["layers"])], 1)
            elif kind == "shortcut":
                x = x + outputs[int(values["from"])]
            elif kind == "yolo":
                raw.append(x)
            else:
                x = layer(x)
            outputs.append(x)
        return [self.rows_of(x, head) for x, head in zip(raw, self.heads)]

    @staticmethod
    def rows_of(x, head):
        batch, _, rows, columns = x.shape
        x = x.view(batch, len(head.anchors), 5 + head.num_classes, rows, columns)
        return x.permute(0, 1, 3, 4, 2)

    def decode(self, raw, head):
        """-> centre and size of boxes relative to the input, (batch, anchors, rows, columns, 4)."""
        rows, columns = raw.shape[2:4]
        grid_y, grid_x = torch.meshgrid(torch.arange(rows), torch.arange(columns), indexing="ij")
        anchors = torch.tensor(head.anchors).view(1, -1, 1, 1, 2)
        x = (raw[..., 0].sigmoid() + grid_x) / columns
        y = (raw[..., 1].sigmoid() + grid_y) / rows
        size = raw[..., 2:4].clamp(max=6).exp() * anchors
        cells = torch.tensor([columns, rows], dtype=raw.dtype)
        # Smaller pictures have fewer cells of the same size.
        return torch.cat([torch.stack([x, y], -1), size / (cells * head.stride)], -1)

    def predict(self, x):
        """-> (batch, boxes, 4 + 1 + classes): box, objectness, class scores times objectness, as
        OpenCV's [yolo] layers give them."""
        result = []
        for raw, head in zip(self(x), self.heads):
            objectness = raw[..., 4:5].sigmoid()
            rows = torch.cat([self.decode(raw, head), objectness,
                              raw[..., 5:].sigmoid() * objectness], -1)
            result.append(rows.permute(0, 2, 3, 1, 4).flatten(1, 3))
        return torch.cat(result, 1)


def convolution(values, channels):
    filters, size = int(values["filters"]), int(values["size"])
    is_normalised = values.get("batch_normalize", "0") == "1"
    layers = [nn.Conv2d(channels, filters, size, int(values["stride"]), size // 2,
                        groups=int(values.get("groups", 1)), bias=not is_normalised)]
    if is_normalised:
        layers.append(nn.BatchNorm2d(filters, eps=1e-6))
    if values["activation"] == "leaky":
        layers.append(nn.LeakyReLU(0.1, inplace=True))
    return nn.Sequential(*layers)


def tensors_in_order(network):
    """The tensors of a .weights file: of each convolution the biases, then scales, means and
    variances if it is normalised, then the kernels."""
    for layer in network.layers:
        if not isinstance(layer, nn.Sequential):
            continue
        norm = next((part for part in layer if isinstance(part, nn.BatchNorm2d)), None)
        if norm is not None:
            yield from (norm.bias, norm.weight, norm.running_mean, norm.running_var)
        else:
            yield layer[0].bias
        yield layer[0].weight


def write_weights(network, path, num_images_seen):
    with open(path, "wb") as file:
        np.array(VERSION, "<i4").tofile(file)
        np.array([num_images_seen], "<i8").tofile(file)
        for tensor in tensors_in_order(network):
            tensor.detach().numpy().astype("<f4").tofile(file)


def read_weights(network, path):
    values = np.fromfile(path, "<f4", offset=20)
    tensors = list(tensors_in_order(network))
    if len(values) != sum(tensor.numel() for tensor in tensors):
        raise ValueError(f"{path}: is of another network")
    begin = 0
    with torch.no_grad():
        for tensor in tensors:
            end = begin + tensor.numel()
            tensor.copy_(torch.from_numpy(values[begin:end].copy()).view(tensor.shape))
            begin = end
