#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 the semslam authors
# SPDX-License-Identifier: BSD-3-Clause
#
# Formats the project's C++ files with clang-format 14.
#   scripts/format.sh [--check]      --check: change nothing, exit 1 and show what differs
set -euo pipefail

mode=(-i)
case "${1:-}" in
  "") ;;
  --check) mode=(--dry-run --Werror) ;;
  --help | -h) sed -n '5,6s/^# \{0,1\}//p' "$0"; exit 0 ;;
  *) echo "$0: unknown option $1 (--help shows the usage)" >&2; exit 2 ;;
esac
command -v clang-format-14 >/dev/null ||
  { echo "$0: no clang-format-14; run scripts/install_dependencies.sh --with-lint" >&2; exit 1; }

cd "$(dirname "${BASH_SOURCE[0]}")/.."
folders=()
for folder in include src Examples test; do
  [[ ! -d "$folder" ]] || folders+=("$folder")
done
find "${folders[@]}" \( -name '*.cc' -o -name '*.h' \) -print0 |
  xargs -0 -r -n 20 -P "$(nproc)" clang-format-14 "${mode[@]}"
