#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 the semslam authors
# SPDX-License-Identifier: BSD-3-Clause
#
# Installs the Debian 12 / Ubuntu packages that semslam needs, as root or with sudo. Does nothing,
# quickly and without a network, if all are there.
#   scripts/install_dependencies.sh [--with-lint] [--with-browser] [--list] [--help]
#     --with-lint     clang-format and clang-tidy as well
#     --with-browser  Chromium and a screen in memory as well, in which the tests look at the
#                     report and the viewer
#     --list          print the packages and install nothing
set -euo pipefail

packages=(
  # Tools
  ca-certificates ccache cmake g++ make ninja-build pkg-config python3
  # Libraries of the project: Thirdparty/README.md says what each is for.
  libceres-dev libcli11-dev libeigen3-dev libembree-dev liblzf-dev libopencv-dev libopenni2-dev
  libpcl-dev libprotobuf-dev libspng-dev libsuitesparse-dev libtbb-dev libturbojpeg0-dev
  libyaml-cpp-dev nlohmann-json3-dev
  # The viewer; the last two draw where there is no graphics card, and so in the tests.
  libegl-dev libglfw3-dev libimgui-dev libopengl-dev libegl-mesa0 libgl1-mesa-dri fonts-dejavu-core
  # Tests and benchmarks
  libbenchmark-dev libgmock-dev libgtest-dev
)
lint_packages=(clang-format-14 clang-tidy-14)
browser_packages=(chromium chromium-driver xvfb libxtst6)

list_only=false
for argument in "$@"; do
  case "$argument" in
    --with-lint) packages+=("${lint_packages[@]}") ;;
    --with-browser) packages+=("${browser_packages[@]}") ;;
    --list) list_only=true ;;
    --help | -h) sed -n '5,11s/^# \{0,1\}//p' "$0"; exit 0 ;;
    *) echo "$0: unknown option $argument (--help shows the usage)" >&2; exit 2 ;;
  esac
done
if $list_only; then
  printf '%s\n' "${packages[@]}"
  exit 0
fi

fail() {
  echo "install_dependencies.sh: $1" >&2
  echo "  missing packages: ${missing[*]}" >&2
  exit 1
}

# Those that dpkg does not know as fully installed; removed ones with configuration left count too.
find_missing() {
  missing=()
  local installed
  # dpkg-query fails if it does not know one of them, and tells of the others all the same.
  installed=$({ dpkg-query -W -f='${db:Status-Status}:${Package}\n' "${packages[@]}" || true; } \
    2>/dev/null | sed -n 's/^installed://p' | tr '\n' ' ')
  local package
  for package in "${packages[@]}"; do
    [[ " $installed" == *" $package "* ]] || missing+=("$package")
  done
}

missing=("${packages[@]}")
for tool in dpkg-query apt-get; do
  command -v "$tool" >/dev/null ||
    fail "no $tool here; install what corresponds to these Debian packages by hand"
done
find_missing
((${#missing[@]})) || exit 0

run_as_root=()
if ((EUID != 0)); then
  command -v sudo >/dev/null || fail "not root and no sudo; ask an administrator for these packages"
  run_as_root=(sudo)
fi
apt_get() {
  # Under a sudo that clears the environment too.
  "${run_as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get -qq -o DPkg::Lock::Timeout=300 "$@" </dev/null
}

echo "Installing ${#missing[@]} packages: ${missing[*]}"
apt_get update || fail "apt-get update failed; is there a network?"
apt_get install -y --no-install-recommends "${missing[@]}" >/dev/null ||
  fail "apt-get install failed; its messages are above (no network, or a release without them?)"
find_missing
((${#missing[@]} == 0)) || fail "still not installed"
