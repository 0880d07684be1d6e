#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 the semslam authors
# SPDX-License-Identifier: BSD-3-Clause
#
# Installs what is missing, builds, makes a labelled 3D map of a sequence, and says how good it is
# and where the files are. Without --sequence it renders a clip of a desk, and needs no network.
#   scripts/demo.sh [options]
#     --sequence DIR               a folder of the TUM RGB-D benchmark (rgb/ depth/ rgb.txt depth.txt)
#     --settings FILE              its camera; known by itself for freiburg1, 2, 3 and rendered clips
#     --network CFG WEIGHTS NAMES  a Darknet detector; default: config/detector, which finds cups,
#                                  keyboards, monitors, mice and teddy bears and was trained on
#                                  rendered desks only
#     --output DIR                 default: demo_output in the project's folder
#     --frames N                   length of the rendered clip, default 150
set -euo pipefail

usage() { sed -n '5,15s/^# \{0,1\}//p' "$0"; }
fail() { echo "demo.sh: $1" >&2; exit 1; }
usage_error() { echo "demo.sh: $1 (--help shows the usage)" >&2; exit 2; }

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
sequence="" settings="" output="$root/demo_output" frames=150
detector="$root/config/detector/desk"
network=(--network "$detector.cfg" "$detector.weights" "$detector.names")
while (($#)); do
  case "$1" in
    --help | -h) usage; exit 0 ;;
    --sequence | --settings | --output | --frames)
      (($# >= 2)) || usage_error "$1 needs a value"
      declare "${1#--}=$2"
      shift 2
      ;;
    --network)
      (($# >= 4)) || usage_error "--network needs CFG WEIGHTS NAMES"
      network=(--network "$(realpath -m -- "$2")" "$(realpath -m -- "$3")" "$(realpath -m -- "$4")")
      shift 4
      ;;
    *) usage_error "unknown option $1" ;;
  esac
done
[[ "$frames" =~ ^[1-9][0-9]*$ ]] || usage_error "--frames: expected a number > 0, found '$frames'"

# The camera of a sequence: its own file, or by the folder's name.
find_settings() {
  local name
  name=$(basename -- "$sequence")
  if [[ -n "$settings" ]]; then
    realpath -m -- "$settings"
  elif [[ -f "$sequence/settings.yaml" ]]; then
    echo "$sequence/settings.yaml"
  elif [[ "$name" =~ (freiburg|fr)([123])(_|$) ]]; then
    echo "$root/config/TUM${BASH_REMATCH[2]}.yaml"
  fi
}

if [[ -n "$sequence" ]]; then
  [[ -d "$sequence" ]] || fail "$sequence: no such folder"
  sequence=$(realpath -- "$sequence")
  settings=$(find_settings)
  [[ -n "$settings" ]] ||
    fail "$sequence: which camera is this? Give --settings FILE (config/ has some; config/README.md)"
fi
for file in "${network[@]:1}" ${settings:+"$settings"}; do
  [[ -f "$file" ]] || fail "$file: no such file"
done
output=$(realpath -m -- "$output")
mkdir -p "$output" || fail "$output: cannot be made"

"$root/scripts/install_dependencies.sh"
"$root/scripts/build.sh" release rgbd_tum evaluate_trajectory render_clip
bin="$root/build/release/bin"

if [[ -z "$sequence" ]]; then
  sequence="$output/clip"
  echo "Rendering $frames frames of a desk to $sequence"
  "$bin/render_clip" desk "$sequence" --frames "$frames" --seed 1
  settings=$(find_settings)
elif [[ "${network[1]}" == "$detector.cfg" ]]; then
  echo "No --network: the detector is the one that ships, which knows rendered desks only"
fi
associations=-
[[ ! -f "$sequence/associations.txt" ]] || associations="$sequence/associations.txt"

# 2 means: done, but tracking was lost for a part; its summary says so, and there is a map.
code=0
"$bin/rgbd_tum" "$root/Vocabulary/orb.voc" "$settings" "$sequence" "$associations" \
  --output "$output/result" "${network[@]}" || code=$?
((code == 0 || code == 2)) || fail "rgbd_tum ended with exit code $code"

if [[ -f "$sequence/groundtruth.txt" ]]; then
  echo
  echo "Against the true trajectory, $sequence/groundtruth.txt:"
  "$bin/evaluate_trajectory" "$sequence/groundtruth.txt" "$output/result/CameraTrajectory.txt"
fi
echo
echo "The map is in $output/result:"
describe() { [[ ! -f "$output/result/$1" ]] || printf '  %-24s %s\n' "$1" "$2"; }
describe semantic_map_view.png "colours, segments and classes side by side: look here first"
describe semantic_map_top.png "the same from above"
describe objects.json "the objects: class, confidence, place, size"
describe semantic_map.ply "the labelled points, for MeshLab, CloudCompare or Open3D"
describe semantic_map.pcd "the same for pcl_viewer"
describe segmentation.pcd "the segments"
describe global_color.pcd "the coloured points"
describe CameraTrajectory.txt "the camera's way"
describe KeyFrameTrajectory.txt "the keyframes"
exit "$code"
