#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 the semslam authors
# SPDX-License-Identifier: BSD-3-Clause
#
# Installs what is missing, builds the release preset and runs all tests. From any folder.
#   scripts/test.sh [--help] [-- CTEST_ARGUMENTS]      e.g. scripts/test.sh -- -R Rigid3
set -euo pipefail

ctest_arguments=()
while (($#)); do
  case "$1" in
    --help | -h) sed -n '5,6s/^# \{0,1\}//p' "$0"; exit 0 ;;
    --) shift; ctest_arguments=("$@"); break ;;
    *) echo "$0: unknown option $1 (--help shows the usage)" >&2; exit 2 ;;
  esac
  shift
done

cd "$(dirname "${BASH_SOURCE[0]}")/.."
scripts/install_dependencies.sh
scripts/build.sh release
ctest --preset release -j "$(nproc)" "${ctest_arguments[@]}"
