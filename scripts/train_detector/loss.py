# SPDX-FileCopyrightText: 2026 the semslam authors
# SPDX-License-Identifier: BSD-3-Clause
"""The loss of YOLOv3 (Redmon and Farhadi 2018) with complete IoU for boxes (Zheng et al. 2020)."""
import math

import torch
from torch.nn import functional

BOX_WEIGHT = 2.5
GOOD_SHAPE = 0.45     # An anchor is used for a box if their shapes overlap that much.
GOOD_OVERLAP = 0.6    # A prediction that overlaps an object so much is not called empty.
HARD_OVERLAP = 0.25   # The same for objects that are hard.


def corners(boxes):
    half = boxes[..., 2:] / 2
    return boxes[..., :2] - half, boxes[..., :2] + half


def overlap(a, b):
    """Intersection over union of boxes given by centre and size."""
    (a_first, a_last), (b_first, b_last) = corners(a), corners(b)
    inner = (torch.min(a_last, b_last) - torch.max(a_first, b_first)).clamp(min=0).prod(-1)
    return inner / (a[..., 2:].prod(-1) + b[..., 2:].prod(-1) - inner + 1e-9)


def complete_overlap(a, b):
    (a_first, a_last), (b_first, b_last) = corners(a), corners(b)
    hull = torch.max(a_last, b_last) - torch.min(a_first, b_first)
    distance = ((a[..., :2] - b[..., :2]) ** 2).sum(-1) / ((hull ** 2).sum(-1) + 1e-9)
    angle = torch.atan(a[..., 2] / (a[..., 3] + 1e-9)) - torch.atan(b[..., 2] / (b[..., 3] + 1e-9))
    shape = 4 / math.pi ** 2 * angle ** 2
    iou = overlap(a, b)
    weight = (shape / (1 - iou + shape + 1e-9)).detach()
    return iou - distance - weight * shape


def responsible(boxes, heads, width, height):
    """For each head (box, anchor) pairs: the anchor of the best shape and all of good shape."""
    anchors = torch.tensor([anchor for head in heads for anchor in head.anchors])
    size = boxes[:, None, 4:6] * torch.tensor([width, height])
    inner = torch.min(size, anchors).prod(-1)
    shape = inner / (size.prod(-1) + anchors.prod(-1) - inner)
    chosen = (shape > GOOD_SHAPE) | (shape == shape.max(1, keepdim=True).values)
    first, result = 0, []
    for head in heads:
        result.append(chosen[:, first:first + len(head.anchors)].nonzero(as_tuple=True))
        first += len(head.anchors)
    return result


def emptiness(decoded, boxes):
    """1 for predictions that may be called empty, 0 for those near an object."""
    flat = decoded.flatten(1, 3)
    empty = torch.ones(flat.shape[:2])
    for picture in range(len(flat)):
        near = boxes[boxes[:, 0] == picture]
        if len(near) == 0:
            continue
        limit = torch.where(near[:, 6] > 0, HARD_OVERLAP, GOOD_OVERLAP)
        overlaps = overlap(flat[picture][:, None], near[None, :, 2:6])
        empty[picture] = (overlaps < limit).all(1).float()
    return empty.view(decoded.shape[:-1])


def detection_loss(network, raw, boxes, width, height):
    """boxes: (n, 7) as from dataset.collate. Returns the loss and its parts, for the log."""
    clear = boxes[boxes[:, 6] == 0]
    pairs = responsible(clear, network.heads, width, height)
    num_pairs = max(1, sum(len(index) for index, _ in pairs))
    place = kind = there = torch.zeros(())
    for outputs, head, (index, anchor) in zip(raw, network.heads, pairs):
        rows, columns = outputs.shape[2:4]
        decoded = network.decode(outputs, head)
        weight = emptiness(decoded.detach(), boxes)
        target = torch.zeros_like(weight)
        truth = clear[index]
        cell = (truth[:, 0].long(), anchor, (truth[:, 3] * rows).long().clamp(max=rows - 1),
                (truth[:, 2] * columns).long().clamp(max=columns - 1))
        target[cell], weight[cell] = 1.0, 1.0
        there = there + (weight * functional.binary_cross_entropy_with_logits(
            outputs[..., 4], target, reduction="none")).sum()
        place = place + (1 - complete_overlap(decoded[cell], truth[:, 2:6])).sum()
        classes = functional.one_hot(truth[:, 1].long(), head.num_classes).float()
        kind = kind + functional.binary_cross_entropy_with_logits(outputs[cell][:, 5:], classes,
                                                                  reduction="sum")
    parts = [BOX_WEIGHT * place / num_pairs, there / num_pairs, kind / num_pairs]
    return sum(parts), [float(part) for part in parts]
