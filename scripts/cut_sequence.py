#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the semslam authors
# SPDX-License-Identifier: BSD-3-Clause
"""Cuts a clip out of a sequence in the TUM RGB-D format: the colour images between two times that
have a depth image within 20 ms, those depth images, and the true trajectory half a second around
them. Writes associations.txt too."""
import argparse
import pathlib
import shutil
import sys
from decimal import Decimal

MAX_DIFFERENCE = Decimal('0.02')
MARGIN = Decimal('0.5')


def read_list(path):
    """(time, rest of the line) for each line of data, in the order of the file."""
    entries = []
    for line in path.read_text(encoding='utf-8').splitlines():
        if line.strip() and not line.startswith('#'):
            time, rest = line.split(maxsplit=1)
            entries.append((Decimal(time), rest))
    return entries


def associate(colors, depths):
    """Pairs of entries, closest in time first, each used once; in the order of time."""
    candidates = sorted((abs(c[0] - d[0]), i, k)
                        for i, c in enumerate(colors) for k, d in enumerate(depths)
                        if abs(c[0] - d[0]) < MAX_DIFFERENCE)
    used_colors, used_depths, pairs = set(), set(), []
    for _, i, k in candidates:
        if i not in used_colors and k not in used_depths:
            used_colors.add(i)
            used_depths.add(k)
            pairs.append((colors[i], depths[k]))
    return sorted(pairs)


def write_list(path, header, entries):
    lines = [f'# {text}' for text in header] + [f'{time} {rest}' for time, rest in entries]
    path.write_text('\n'.join(lines) + '\n', encoding='utf-8')


def cut(sequence, output, first, last):
    near = [[e for e in read_list(sequence / f'{kind}.txt') if first - 1 <= e[0] <= last + 1]
            for kind in ('rgb', 'depth')]
    pairs = [p for p in associate(*near) if first <= p[0][0] <= last]
    if not pairs:
        sys.exit(f'{sequence}: no images between {first} and {last}')
    for index, (kind, title) in enumerate((('rgb', 'color images'), ('depth', 'depth maps'))):
        (output / kind).mkdir(parents=True, exist_ok=True)
        entries = [pair[index] for pair in pairs]
        for _, name in entries:
            shutil.copyfile(sequence / name, output / name)
        write_list(output / f'{kind}.txt', (title, 'timestamp filename'), entries)
    write_list(output / 'associations.txt', (),
               [(c[0], f'{c[1]} {d[0]} {d[1]}') for c, d in pairs])
    truth = [e for e in read_list(sequence / 'groundtruth.txt')
             if first - MARGIN <= e[0] <= last + MARGIN]
    write_list(output / 'groundtruth.txt',
               ('ground truth trajectory', 'timestamp tx ty tz qx qy qz qw'), truth)
    print(f'{output}: {len(pairs)} frames')


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('sequence', type=pathlib.Path)
    parser.add_argument('output', type=pathlib.Path)
    parser.add_argument('--from', dest='first', type=Decimal, required=True, metavar='TIME')
    parser.add_argument('--to', dest='last', type=Decimal, required=True, metavar='TIME')
    arguments = parser.parse_args()
    cut(arguments.sequence, arguments.output, arguments.first, arguments.last)


if __name__ == '__main__':
    main()
