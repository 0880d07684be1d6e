#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 the semslam authors
# SPDX-License-Identifier: BSD-3-Clause
#
# Configures and builds a preset, on as many jobs as there are cores and memory for.
#   scripts/build.sh [PRESET] [TARGET ...]      PRESET: release (default), dev, asan, tsan
set -euo pipefail
if [[ "${1:-}" == --help || "${1:-}" == -h ]]; then
  sed -n '5,6s/^# \{0,1\}//p' "$0"
  exit 0
fi
cd "$(dirname "${BASH_SOURCE[0]}")/.."

preset="${1:-release}"
shift || true
# A file that includes PCL takes up to 1.5 GB to compile.
memory_jobs=$(awk '/^MemAvailable:/ {print int($2 / 1572864)}' /proc/meminfo)
jobs=$(nproc)
((memory_jobs >= jobs)) || jobs=$((memory_jobs > 1 ? memory_jobs : 1))

log=$(mktemp)
trap 'rm -f "$log"' EXIT
cmake --preset "$preset" >"$log" 2>&1 || { cat "$log" >&2; exit 1; }
arguments=(--build --preset "$preset" -j "$jobs")
(($# == 0)) || arguments+=(--target "$@")
cmake "${arguments[@]}"
