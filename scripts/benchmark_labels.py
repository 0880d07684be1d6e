#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the semslam authors
# SPDX-License-Identifier: BSD-3-Clause
"""Maps rendered desks with the detector that ships, and prints what the labels are worth.

    scripts/benchmark_labels.py FOLDER [--runs N] [--frames N] [--desks desk:1,random:1,...]

Clips and results go into FOLDER (90 MB a desk); clips that are there are used again.
"""
import argparse
import json
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
PROGRAMS = ROOT / "build/release/bin"
DETECTOR = ROOT / "config/detector/desk"
DESKS = ",".join(["desk:1"] + [f"random:{seed}" for seed in range(1, 11)])


def run(*command):
    result = subprocess.run([str(part) for part in command], capture_output=True, text=True,
                            check=False)
    if result.returncode != 0:
        sys.exit(f"{command[0]}: exit code {result.returncode}: {result.stderr.strip()[-500:]}")


def render(folder, desk, frames):
    scene, seed = desk.split(":")
    clip = folder / f"{scene}{seed}"
    if not (clip / "associations.txt").exists():
        run(PROGRAMS / "render_clip", scene, clip, "--seed", seed, "--frames", frames)
    return clip


def measure(clip, output):
    run(PROGRAMS / "rgbd_tum", ROOT / "Vocabulary/orb.voc", clip / "settings.yaml", clip,
        clip / "associations.txt", "--network", f"{DETECTOR}.cfg", f"{DETECTOR}.weights",
        f"{DETECTOR}.names", "--save-detections", "--output", output)
    run(PROGRAMS / "evaluate_map", clip, output, "--detections", output / "detections",
        "--json", output / "evaluation.json")
    evaluation = json.loads((output / "evaluation.json").read_text())
    labels, objects = evaluation["labels"], evaluation["objects"][0]
    simpler = labels["baselines"]
    return {"accuracy": labels["accuracy_on_objects"], "mean IoU": labels["mean_iou"],
            "bleeding": labels["bleeding"], "painted": simpler["painted boxes"]["mean_iou"],
            "votes by point": simpler["votes by point"]["mean_iou"],
            "votes by segment": simpler["votes by segment"]["mean_iou"],
            "true": objects["num_true"], "found": objects["num_found"],
            "right": objects["num_matched"]}


def print_row(name, row):
    print(f"{name:<16}" + "".join(f"{value:>18.3f}" if isinstance(value, float) else f"{value:>18}"
                                  for value in row.values()), flush=True)


def main():
    parser = argparse.ArgumentParser(description="What the labels are worth on rendered desks.")
    parser.add_argument("folder", type=pathlib.Path, help="for clips and results")
    parser.add_argument("--runs", type=int, default=1, help="of each desk")
    parser.add_argument("--frames", type=int, default=150, help="of each clip")
    parser.add_argument("--desks", default=DESKS, help="scene:seed, with commas between")
    arguments = parser.parse_args()
    rows = []
    for desk in arguments.desks.split(","):
        clip = render(arguments.folder, desk, arguments.frames)
        for number in range(arguments.runs):
            output = arguments.folder / "results" / f"{clip.name}_{number}"
            output.mkdir(parents=True, exist_ok=True)
            rows.append(measure(clip, output))
            if len(rows) == 1:
                print(" " * 16 + "".join(f"{name:>18}" for name in rows[0]))
            print_row(f"{clip.name} run {number + 1}", rows[-1])
    counts = {name: sum(row[name] for row in rows) for name in ("true", "found", "right")}
    print_row("mean, sums", {name: sum(row[name] or 0.0 for row in rows) / len(rows)
                             if name not in counts else counts[name] for name in rows[0]})


if __name__ == "__main__":
    main()
