# shellcheck shell=bash
# SPDX-FileCopyrightText: 2026 the semslam authors
# SPDX-License-Identifier: BSD-3-Clause
#
# Sourced by get_tum.sh and get_models.sh.

# download URL FILE: resumes a part that is there; the file appears only once it is whole.
download() {
  local url=$1 file=$2 code=0
  echo "Fetching $url"
  if command -v curl >/dev/null; then
    curl --fail --location --silent --show-error --connect-timeout 20 --retry 3 --continue-at - \
      --output "$file.part" "$url" || code=$?
  elif command -v wget >/dev/null; then
    wget --no-verbose --timeout=20 --tries=3 --continue --output-document="$file.part" "$url" || code=$?
  else
    echo "neither curl nor wget is here: apt-get install curl" >&2
    return 1
  fi
  if ((code)); then
    echo "$url: could not be fetched. Is there a network? It can be fetched elsewhere, put at" >&2
    echo "  $file" >&2
    echo "and this script run again." >&2
    return 1
  fi
  mv "$file.part" "$file"
}
