#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the semslam authors
# SPDX-License-Identifier: BSD-3-Clause
"""Trains the network of a Darknet .cfg on pictures that render_data.py wrote.

    train.py DATA CFG WEIGHTS [--check DATA] [--epochs 20]

writes WEIGHTS after each epoch: the running mean of the network, which is better than its last
state. With --check it says the average precision on other pictures.
"""
import argparse
import copy
import math
import os
import pathlib
import time

os.environ.setdefault("OMP_WAIT_POLICY", "PASSIVE")  # Busy waiting is slow beside other programs.
import torch

import darknet
from dataset import Desks, collate
from loss import detection_loss
from precision import average_precision, suppress

SMALL_PART = 0.6       # Of the epochs that learn from smaller pictures first, which is faster.
SMALL_SCALE = 2 / 3
WARM_UP_STEPS = 200
MEAN_STEPS = 400       # That the running mean looks back over.


def learning_rate(step, num_steps, peak):
    warm = min(1.0, (step + 1) / WARM_UP_STEPS)
    return peak * warm * (0.02 + 0.98 * 0.5 * (1 + math.cos(math.pi * step / num_steps)))


class RunningMean:
    """Of a network's tensors, over the last steps."""

    def __init__(self, network):
        self.network = copy.deepcopy(network).eval()
        self.num_steps = 0

    @torch.no_grad()
    def update(self, network):
        self.num_steps += 1
        keep = min(1 - 1 / MEAN_STEPS, self.num_steps / (self.num_steps + 10))
        values = network.state_dict()
        for name, mean in self.network.state_dict().items():
            if mean.dtype.is_floating_point:
                mean.mul_(keep).add_(values[name], alpha=1 - keep)


def input_size(network, is_small):
    """Of the pictures in an epoch; multiples of 32."""
    scale = SMALL_SCALE if is_small else 1
    return [round(size * scale / 32) * 32 for size in (network.width, network.height)]


@torch.no_grad()
def check(network, folder, names):
    desks = Desks(folder, network.width, network.height, augment=False)
    found, truth = [], []
    for picture, boxes in desks:
        found.append(suppress(network.predict(picture[None].float() / 255)[0], 0.02))
        truth.append(boxes)
    values = [average_precision(found, truth, i) for i in range(network.heads[0].num_classes)]
    each = ", ".join(f"{name} {value:.3f}" for name, value in zip(names, values))
    return f"AP50 {sum(values) / len(values):.3f} ({each})"


def parameter_groups(network):
    """Only kernels are drawn towards zero."""
    kernels = [p for p in network.parameters() if p.ndim > 1]
    others = [p for p in network.parameters() if p.ndim == 1]
    return [{"params": kernels, "weight_decay": 0.02}, {"params": others, "weight_decay": 0.0}]


def prepare(network):
    """At first nothing is anywhere."""
    last = [layer for (kind, _), layer in zip(network.sections, network.layers)
            if kind == "convolutional" and len(layer) == 1]
    for head, layer in zip(network.heads, last):
        with torch.no_grad():
            layer[0].bias.view(len(head.anchors), -1)[:, 4] = -5.0


def train(network, arguments, names):
    optimizer = torch.optim.AdamW(parameter_groups(network), lr=arguments.rate)
    mean = RunningMean(network)
    num_batches = arguments.pictures // arguments.batch
    num_steps, step, seen = arguments.epochs * num_batches, 0, 0
    for epoch in range(arguments.epochs):
        size = input_size(network, epoch < SMALL_PART * arguments.epochs)
        desks = Desks(arguments.data, *size, augment=True, seed=(arguments.seed, epoch))
        sampler = torch.utils.data.RandomSampler(desks, num_samples=num_batches * arguments.batch)
        loader = torch.utils.data.DataLoader(desks, arguments.batch, sampler=sampler,
                                             num_workers=arguments.workers, collate_fn=collate)
        start, sums = time.time(), [0.0, 0.0, 0.0]
        network.train()
        for pictures, boxes in loader:
            for group in optimizer.param_groups:
                group["lr"] = learning_rate(step, num_steps, arguments.rate)
            loss, parts = detection_loss(network, network(pictures), boxes, *size)
            optimizer.zero_grad()
            loss.backward()
            torch.nn.utils.clip_grad_norm_(network.parameters(), 10.0)
            optimizer.step()
            mean.update(network)
            step, seen = step + 1, seen + len(pictures)
            sums = [a + b for a, b in zip(sums, parts)]
        darknet.write_weights(mean.network, arguments.weights, seen)
        parts = ", ".join(f"{name} {value / num_batches:.3f}"
                          for name, value in zip(("boxes", "objectness", "classes"), sums))
        rate = num_batches * arguments.batch / (time.time() - start)
        print(f"epoch {epoch + 1}: {parts}; {rate:.1f} pictures/s", flush=True)
        if arguments.check and ((epoch + 1) % arguments.check_every == 0 or
                                epoch + 1 == arguments.epochs):
            print(f"epoch {epoch + 1}: {check(mean.network, arguments.check, names)}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("data", type=pathlib.Path)
    parser.add_argument("cfg", type=pathlib.Path)
    parser.add_argument("weights", type=pathlib.Path)
    parser.add_argument("--check", type=pathlib.Path, help="folder of pictures to measure on")
    parser.add_argument("--check-every", type=int, default=2, help="epochs")
    parser.add_argument("--start", type=pathlib.Path, help="weights to start from")
    parser.add_argument("--epochs", type=int, default=20)
    parser.add_argument("--pictures", type=int, default=1600, help="in an epoch")
    parser.add_argument("--batch", type=int, default=16)
    parser.add_argument("--rate", type=float, default=3e-3, help="highest learning rate")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--workers", type=int, default=2, help="processes that prepare pictures")
    arguments = parser.parse_args()
    torch.manual_seed(arguments.seed)
    torch.set_num_threads(arguments.threads)
    names = arguments.cfg.with_suffix(".names").read_text().split("\n")[:-1]
    network = darknet.Network(arguments.cfg)
    prepare(network)
    if arguments.start:
        darknet.read_weights(network, arguments.start)
    train(network, arguments, names)


if __name__ == "__main__":
    main()
