# SPDX-FileCopyrightText: 2026 the semslam authors
# SPDX-License-Identifier: BSD-3-Clause
"""Pictures and boxes that render_data.py wrote, changed at random for training: real pictures are
not like rendered ones, so colours are changed far more than light would."""
import pathlib

import cv2
import numpy as np
import torch

GREY = 128


def read_boxes(path):
    """(n, 6): class, centre x, y, width, height relative to the picture, hard."""
    text = pathlib.Path(path).read_text()
    return np.array([line.split() for line in text.splitlines()], np.float32).reshape(-1, 6)


class Desks(torch.utils.data.Dataset):
    """Items: picture (3, height, width), 8-bit RGB, and its boxes as in read_boxes. The seed, two
    numbers, says how they are changed."""

    def __init__(self, folder, width, height, augment, seed=(0, 0)):
        self.pictures = sorted(pathlib.Path(folder).glob("*.jpg"))
        self.width, self.height, self.augment, self.seed = width, height, augment, seed

    def __len__(self):
        return len(self.pictures)

    def __getitem__(self, index):
        path = self.pictures[index]
        picture = cv2.imread(str(path))
        boxes = read_boxes(path.with_suffix(".txt"))
        if self.augment:
            random = np.random.default_rng([*self.seed, index])
            picture, boxes = crop(picture, boxes, self.width, self.height, random)
            picture = recolor(picture, random)
        else:
            picture = cv2.resize(picture, (self.width, self.height))
        picture = np.ascontiguousarray(picture[:, :, ::-1].transpose(2, 0, 1))
        return torch.from_numpy(picture), torch.from_numpy(boxes)


def collate(items):
    """-> pictures (batch, 3, height, width) and boxes (n, 7): number of the picture, then as in
    read_boxes."""
    pictures = torch.stack([picture for picture, _ in items]).float() / 255
    boxes = [torch.cat([torch.full((len(boxes), 1), float(i)), boxes], 1)
             for i, (_, boxes) in enumerate(items)]
    return pictures, torch.cat(boxes)


def crop(picture, boxes, width, height, random):
    """A part of the picture, or the picture with a grey border, mirrored or not."""
    full_height, full_width = picture.shape[:2]
    scale = width / full_width * np.exp(random.uniform(np.log(0.6), np.log(1.7)))
    aspect = np.exp(random.uniform(-0.1, 0.1))
    scale_x, scale_y = scale * aspect, scale / aspect
    left = random.random() * (width - scale_x * full_width)
    top = random.random() * (height - scale_y * full_height)
    if random.random() < 0.5:
        scale_x, left = -scale_x, left + scale_x * full_width
    matrix = np.array([[scale_x, 0, left], [0, scale_y, top]])
    picture = cv2.warpAffine(picture, matrix, (width, height), flags=cv2.INTER_LINEAR,
                             borderValue=(GREY, GREY, GREY))
    centre = boxes[:, 1:3] * [full_width * scale_x, full_height * scale_y] + [left, top]
    half = boxes[:, 3:5] * [full_width * abs(scale_x), full_height * scale_y] / 2
    first = np.clip(centre - half, 0, [width, height])
    last = np.clip(centre + half, 0, [width, height])
    size = last - first
    area_left = size.prod(1) / np.maximum((4 * half.prod(1)), 1e-6)
    hard = (boxes[:, 5] > 0) | (area_left < 0.2) | (size.min(1) < 5)
    relative = np.concatenate([(first + last) / 2, size], 1) / [width, height, width, height]
    boxes = np.concatenate([boxes[:, :1], relative, hard[:, None]], 1).astype(np.float32)
    return picture, boxes[size.min(1) > 1]


def recolor(picture, random):
    height, width = picture.shape[:2]
    if random.random() < 0.7:
        hsv = cv2.cvtColor(picture, cv2.COLOR_BGR2HSV).astype(np.int16)
        hsv[..., 0] = (hsv[..., 0] + random.integers(-25, 26)) % 180
        hsv[..., 1] = np.clip(hsv[..., 1] * random.uniform(0.2, 1.7), 0, 255)
        picture = cv2.cvtColor(hsv.astype(np.uint8), cv2.COLOR_HSV2BGR)
    x = picture.astype(np.float32) / 255
    if random.random() < 0.3:  # Light from one side.
        ramp = np.linspace(*random.uniform(0.5, 1.4, 2), width, dtype=np.float32)[None, :, None]
        x = x * ramp
    if random.random() < 0.5:  # Gamma.
        x = x ** np.float32(np.exp(random.uniform(-0.5, 0.5)))
    gain = np.exp(random.uniform(-0.5, 0.45)) * random.uniform(0.85, 1.15, 3)
    offset = random.uniform(-0.1, 0.1)
    x = x * gain.astype(np.float32) + np.float32(offset)
    if random.random() < 0.35:
        if random.random() < 0.5:
            x = cv2.GaussianBlur(x, (0, 0), random.uniform(0.4, 1.6))
        else:  # The camera moves.
            length = int(random.integers(2, 8))
            shape = (1, length) if random.random() < 0.5 else (length, 1)
            x = cv2.blur(x, shape[::-1])
    elif random.random() < 0.3:  # Sharpened by the camera.
        x = x + np.float32(random.uniform(0.2, 1.0)) * (x - cv2.GaussianBlur(x, (0, 0), 1.2))
    if random.random() < 0.6:
        deviation = np.float32(random.uniform(0, 0.05))
        x = x + deviation * random.standard_normal((height, width, 3), np.float32)
    return np.clip(x * 255, 0, 255).astype(np.uint8)
