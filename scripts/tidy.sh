#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 the semslam authors
# SPDX-License-Identifier: BSD-3-Clause
#
# Runs clang-tidy 14 on the project's sources (src and Examples), as many at a time as there are
# cores, with the compile commands of build/release.
#   scripts/tidy.sh [--changed] [--budget SECONDS] [FILE.cc ...]
#     --changed   only sources that differ from main, or include a header that does
#     --budget S  start no further file after S seconds; files left out are counted and named, and
#                 those that changed most recently come first
set -euo pipefail

usage() { sed -n '5,10s/^# \{0,1\}//p' "$0"; }
changed=false
budget=0
files=()
while (($#)); do
  case "$1" in
    --changed) changed=true ;;
    --budget) budget="${2:?--budget needs a number of seconds}"; shift ;;
    --help | -h) usage; exit 0 ;;
    -*) echo "$0: unknown option $1 (--help shows the usage)" >&2; exit 2 ;;
    *) files+=("$(realpath -- "$1")") ;;
  esac
  shift
done
command -v clang-tidy-14 >/dev/null ||
  { echo "$0: no clang-tidy-14; run scripts/install_dependencies.sh --with-lint" >&2; exit 1; }

cd "$(dirname "${BASH_SOURCE[0]}")/.."
cmake --preset release >/dev/null 2>&1 || cmake --preset release
options=(--budget "$budget")
! $changed || options+=(--changed)
exec python3 scripts/run_tidy.py "${options[@]}" "${files[@]}"
