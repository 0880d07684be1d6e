#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 the semslam authors
# SPDX-License-Identifier: BSD-3-Clause
#
# Fetches sequences of the TUM RGB-D benchmark (CC BY 4.0; cite Sturm et al., IROS 2012).
#   scripts/get_tum.sh [--output DIR] NAME ...   e.g. fr1_xyz fr1_desk fr2_desk
#   scripts/get_tum.sh [--output DIR] --clips    the two short clips that the tests use
#     --output DIR   default: data in the project's folder
# Then: scripts/demo.sh --sequence DIR/rgbd_dataset_freiburg1_xyz. For the tests, set
# SEMSLAM_CLIPS to DIR/clips.
set -euo pipefail
readonly home="https://cvg.cit.tum.de/rgbd/dataset"

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
source "$root/scripts/download.sh"
usage() { sed -n '5,10s/^# \{0,1\}//p' "$0"; }
output="$root/data" clips=false names=()
while (($#)); do
  case "$1" in
    --help | -h) usage; exit 0 ;;
    --output) output="${2:?--output needs a folder}"; shift ;;
    --clips) clips=true ;;
    -*) echo "$0: unknown option $1 (--help shows the usage)" >&2; exit 2 ;;
    *) names+=("$1") ;;
  esac
  shift
done
if ((${#names[@]} == 0)) && ! $clips; then
  usage >&2
  exit 2
fi
mkdir -p "$output"

get_sequence() {  # fr1_xyz -> $output/rgbd_dataset_freiburg1_xyz
  if [[ ! "$1" =~ ^(fr|freiburg)([123])_([a-z0-9_]+)$ ]]; then
    echo "$1: expected a name like fr1_xyz; all are listed on ${home}/download" >&2
    return 1
  fi
  local folder="rgbd_dataset_freiburg${BASH_REMATCH[2]}_${BASH_REMATCH[3]}"
  local archive="$output/$folder.tgz"
  if [[ -f "$output/$folder/groundtruth.txt" ]]; then
    echo "$output/$folder is there already"
    return
  fi
  [[ -f "$archive" ]] ||
    download "$home/freiburg${BASH_REMATCH[2]}/$folder.tgz" "$archive" || return 1
  # Unpacked aside, so that a folder with the right name is a whole one.
  rm -rf "$output/$folder.unpacking"
  mkdir "$output/$folder.unpacking"
  if ! tar -xzf "$archive" -C "$output/$folder.unpacking"; then
    echo "$archive: not a whole archive; delete it and try again" >&2
    return 1
  fi
  mv "$output/$folder.unpacking/$folder" "$output/$folder"
  rmdir "$output/$folder.unpacking"
  rm "$archive"
  echo "$output/$folder: $(grep -cv '^#' "$output/$folder/rgb.txt") colour images"
}

for name in "${names[@]}"; do
  get_sequence "$name"
done
if $clips; then
  get_sequence fr1_xyz
  get_sequence fr1_desk
  cut="$root/scripts/cut_sequence.py"
  python3 "$cut" "$output/rgbd_dataset_freiburg1_xyz" "$output/clips/fr1_xyz_160" \
    --from 1305031102.175304 --to 1305031107.675568
  python3 "$cut" "$output/rgbd_dataset_freiburg1_desk" "$output/clips/fr1_desk_80" \
    --from 1305031455.359630 --to 1305031458.427598
  echo "For the tests: export SEMSLAM_CLIPS=$output/clips"
fi
