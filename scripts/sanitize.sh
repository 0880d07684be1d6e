#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 the semslam authors
# SPDX-License-Identifier: BSD-3-Clause
#
# Builds the test programs with sanitizers and runs the tests that fit them.
#   scripts/sanitize.sh asan    address and undefined behaviour: the tests labelled unit or threads
#   scripts/sanitize.sh tsan    data races: the tests labelled threads
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

case "${1:-}" in
  asan) labels='^(unit|threads)$' ;;
  tsan) labels='^threads$' ;;
  --help | -h) sed -n '5,7s/^# \{0,1\}//p' "$0"; exit 0 ;;
  *) echo "usage: $0 asan|tsan" >&2; exit 2 ;;
esac
preset=$1

export ASAN_OPTIONS="detect_stack_use_after_return=1:strict_string_checks=1"
export UBSAN_OPTIONS="print_stacktrace=1:halt_on_error=1"
# Debian's libraries (TBB, OpenCV) are not instrumented: what they lock cannot be seen.
export TSAN_OPTIONS="halt_on_error=1:second_deadlock_stack=1:ignore_noninstrumented_modules=1"

scripts/build.sh "$preset" "semslam_${preset}_tests"
ctest --test-dir "build/$preset" -L "$labels" --output-on-failure --no-tests=error -j "$(nproc)"
