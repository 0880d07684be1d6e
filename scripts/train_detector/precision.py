# SPDX-FileCopyrightText: 2026 the semslam authors
# SPDX-License-Identifier: BSD-3-Clause
"""Average precision while training; evaluate_detector is what counts."""
import numpy as np
import torch

from loss import overlap


def suppress(rows, threshold, overlap_limit=0.45):
    """(n, 6) of one picture, best first: class, box, score; weaker boxes over a stronger one of the
    class left out."""
    scores, classes = rows[:, 5:].max(1)
    keep = scores > threshold
    rows, scores, classes = rows[keep], scores[keep], classes[keep]
    kept = []
    for i in scores.argsort(descending=True).tolist():
        if all(classes[i] != classes[k] or overlap(rows[i, :4], rows[k, :4]) < overlap_limit
               for k in kept):
            kept.append(i)
    return torch.cat([classes[kept, None].float(), rows[kept, :4], scores[kept, None]], 1)


def average_precision(found, truth, class_id, limit=0.5):
    """found: list of (n, 6) and truth: list of (n, 6) as in read_boxes, one for each picture."""
    hits, scores, num_objects = [], [], 0
    for detections, boxes in zip(found, truth):
        boxes = boxes[boxes[:, 0] == class_id]
        num_objects += int((boxes[:, 5] == 0).sum())
        used = set()
        for detection in detections[detections[:, 0] == class_id]:
            overlaps = overlap(detection[1:5], boxes[:, 1:5])
            order = [i for i in overlaps.argsort(descending=True).tolist()
                     if overlaps[i] >= limit and i not in used]
            easy = [i for i in order if boxes[i, 5] == 0]
            if order and not easy:
                continue  # A hard one: neither right nor wrong.
            used.update(easy[:1])
            hits.append(bool(easy))
            scores.append(float(detection[5]))
    if not num_objects:
        return float("nan")
    hits = np.array(hits, bool)[np.argsort(-np.array(scores), kind="stable")]
    recall = np.cumsum(hits) / num_objects
    precision = np.cumsum(hits) / np.arange(1, len(hits) + 1)
    envelope = np.maximum.accumulate(precision[::-1])[::-1]
    return float(np.sum(np.diff(recall, prepend=0) * envelope)) if len(hits) else 0.0
