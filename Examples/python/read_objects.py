#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the semslam authors
# SPDX-License-Identifier: BSD-3-Clause
"""Reads objects.json and prints what is where: an example that needs nothing but Python.

    read_objects.py objects.json [--class NAME]

docs/objects.schema.json describes the file.
"""
import argparse
import json
import sys

FORMAT = "semslam objects 3"


def read_objects(path):
    """The objects by id. Raises OSError or ValueError."""
    with open(path, encoding="utf-8") as file:
        root = json.load(file)
    if not isinstance(root, dict) or root.get("format") != FORMAT:
        raise ValueError(f"{path}: expected an object of format '{FORMAT}'")
    return {item["id"]: item for item in root["objects"]}


def name_of_support(item, objects):
    support = item["supported_by"]
    if support["object"]:
        return f"{objects[support['object']]['class']} {support['object']}"
    return f"segment {support['segment']}" if support["segment"] else "-"


def main():
    parser = argparse.ArgumentParser(description="Prints the objects of a semantic map.")
    parser.add_argument("file", help="objects.json, as rgbd_tum writes it")
    parser.add_argument("--class", dest="name", help="only objects of this class")
    arguments = parser.parse_args()
    try:
        objects = read_objects(arguments.file)
    except (OSError, ValueError) as error:
        sys.exit(f"read_objects.py: {error}")
    print(f"{'id':>4}  {'class':<14} {'sure':>4} {'views':>5}  {'centroid (m)':<24}"
          f"{'size (m)':<20} stands on")
    for item in objects.values():
        if arguments.name and item["class"] != arguments.name:
            continue
        centroid = " ".join(f"{value:7.3f}" for value in item["centroid"])
        size = " x ".join(f"{value:.2f}" for value in item["box"]["size"])
        print(f"{item['id']:>4}  {item['class']:<14} {item['confidence']:>4.2f} "
              f"{item['num_views']:>5}  {centroid:<24}{size:<20} "
              f"{name_of_support(item, objects)}")


if __name__ == "__main__":
    main()
