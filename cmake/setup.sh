#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs the packages of cmake/packages.txt that are missing.
# Usage: sh cmake/setup.sh build|test|manual     (the others include build)
set -eu

list="$(dirname "$0")/packages.txt"
case "${1:-build}" in
  build) sections='build' ;;
  test) sections='build test' ;;
  manual) sections='build manual' ;;
  *) echo "setup.sh: expected 'build', 'test' or 'manual', found '$1'" >&2; exit 2 ;;
esac

release=$(. /etc/os-release && echo "${VERSION_CODENAME:-}") 2>/dev/null || release=''
packages=$(for section in $sections; do
  awk -v wanted="[$section]" -v release="$release" '
    /^\[/ {on = ($0 == wanted)}
    !/^[[#]/ && NF && on {
      known = NF == 1
      for (k = 2; k <= NF; ++k) known = known || $k == release
      if (known) print $1
    }' "$list"
done)

if ! command -v dpkg-query >/dev/null 2>&1; then
  echo "setup.sh: not a Debian system, so nothing was installed. flexneck needs:" >&2
  echo "$packages" | sed 's/^/  /' >&2
  echo "Install the corresponding packages, then: cmake --preset release && cmake --build build" >&2
  exit 2
fi

missing=''
for package in $packages; do
  status=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null || true)
  [ "$status" = installed ] || missing="$missing $package"
done
[ -n "$missing" ] || exit 0

if [ "$(id -u)" -eq 0 ]; then
  as_root=''
elif command -v sudo >/dev/null 2>&1; then
  as_root='sudo'
else
  echo "setup.sh: neither root nor sudo is available; ask an administrator for: apt-get install$missing" >&2
  exit 2
fi

echo "Installing:$missing"
log=$(mktemp)
trap 'rm -f "$log"' EXIT
# shellcheck disable=SC2086
if ! { $as_root apt-get update &&
       $as_root env DEBIAN_FRONTEND=noninteractive \
         apt-get install -y --no-install-recommends $missing; } >"$log" 2>&1; then
  cat "$log" >&2
  exit 2
fi
