#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs the two commands of the README, from the last commit, in a bare Debian 13.
# Usage, as root: debian13.sh OUT       (wants mmdebstrap; MIRROR=http://… for a mirror)
set -eu

out=$(realpath "$1")
sources=$(cd "$(dirname "$0")/../.." && pwd)
root=$out/root

mmdebstrap --variant=minbase --mode=root --aptopt='APT::Sandbox::User "root"' \
  --include=ca-certificates,git trixie "$root" ${MIRROR:-} 2>"$out/mmdebstrap.log"
mount -t proc proc "$root/proc"  # by which the program finds itself
mount -t sysfs -o ro sys "$root/sys"
mount --bind /dev "$root/dev"
trap 'umount "$root/proc" "$root/sys" "$root/dev"' EXIT
git clone -q "$sources" "$root/flexneck"

inside() {
  chroot "$root" env -i PATH=/usr/bin:/bin:/usr/sbin:/sbin HOME=/root LC_ALL=C.UTF-8 \
    OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 "$@"
}
inside sh /flexneck/pipeline/run.sh -o /tmp/out
inside sh /flexneck/tests/run.sh
