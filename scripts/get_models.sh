#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 the semslam authors
# SPDX-License-Identifier: BSD-3-Clause
#
# Fetches detectors trained on COCO by the authors of YOLOv3 (public domain): cfg, weights, names.
#   scripts/get_models.sh [--output DIR] [yolov3 | yolov3-tiny] ...    default: yolov3-tiny
#     --output DIR   default: models in the project's folder
# Then: scripts/demo.sh --network DIR/yolov3-tiny.cfg DIR/yolov3-tiny.weights DIR/coco.names ...
set -euo pipefail
readonly weights_home="https://pjreddie.com/media/files"
readonly text_home="https://raw.githubusercontent.com/pjreddie/darknet/master"

# Sizes follow from the networks: 20 bytes of header and 4 for each parameter. The authors publish
# no checksums, so none are claimed here: the sums of what came are printed.
declare -A weights_bytes=([yolov3]=248007048 [yolov3-tiny]=35434956)

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
source "$root/scripts/download.sh"
output="$root/models" names=()
while (($#)); do
  case "$1" in
    --help | -h) sed -n '5,8s/^# \{0,1\}//p' "$0"; exit 0 ;;
    --output) output="${2:?--output needs a folder}"; shift ;;
    yolov3 | yolov3-tiny) names+=("$1") ;;
    *) echo "$0: unknown: $1 (--help shows the usage)" >&2; exit 2 ;;
  esac
  shift
done
((${#names[@]})) || names=(yolov3-tiny)
mkdir -p "$output"

get() {  # URL FILE
  [[ -f "$2" ]] || download "$1" "$2"
}

get "$text_home/data/coco.names" "$output/coco.names"
for name in "${names[@]}"; do
  get "$text_home/cfg/$name.cfg" "$output/$name.cfg"
  weights="$output/$name.weights"
  get "$weights_home/$name.weights" "$weights"
  bytes=$(stat -c %s "$weights")
  if ((bytes != weights_bytes[$name])); then
    echo "$weights: expected ${weights_bytes[$name]} bytes, found $bytes; delete it and try again" >&2
    exit 1
  fi
  sha256sum "$output/$name.cfg" "$weights"
done
sha256sum "$output/coco.names"
