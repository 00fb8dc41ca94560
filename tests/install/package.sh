#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Makes the .deb, installs it into a bare Debian 12 and runs the built-in study and the consumer there.
# Usage, as root: package.sh BUILD OUT       (wants mmdebstrap)
set -eu

build=$1
out=$(realpath "$2")
sources=$(cd "$(dirname "$0")/../.." && pwd)
root=$out/root

echo '== packages'
rm -f "$build"/*.deb
(cd "$build" && cpack -G DEB >"$out/cpack.log")
ls -l "$build"/*.deb
for deb in "$build"/*.deb; do
  dpkg-deb --info "$deb" | sed -n '/Package:/,$p'
done

echo '== a bare root'
rm -rf "$root"
mmdebstrap --variant=apt --mode=root --aptopt='APT::Sandbox::User "root"' --include=ca-certificates bookworm "$root" ${MIRROR:-} 2>"$out/mmdebstrap.log"
mount -t proc proc "$root/proc"  # by which the program finds itself
mount -t sysfs -o ro sys "$root/sys"
trap 'umount "$root/proc" "$root/sys"' EXIT
cp "$build"/*.deb "$root/tmp"
cp -r "$sources/tests/install/consumer" "$root/tmp/consumer"
inside() { chroot "$root" env -i PATH=/usr/bin:/bin:/usr/sbin:/sbin HOME=/root LC_ALL=C.UTF-8 \
  OMP_NUM_THREADS=1 DEBIAN_FRONTEND=noninteractive "$@"; }

echo '== the command'
begin=$(date +%s)
# What it takes of the processor, too: the clock of a busy machine says little.
(inside sh -c 'apt-get update && apt-get install -y --no-install-recommends /tmp/flexneck_*.deb' >"$out/apt.log" 2>&1
  times >"$out/apt.times")
installed=$(date +%s)
(inside sh -c 'cd /tmp && flexneck run -o out' >"$out/run.log" 2>&1
  times >"$out/run.times")
end=$(date +%s)
grep -A 16 '^Verification' "$out/run.log"
echo "installed in $((installed - begin)) s; from 'apt install' to the last verdict $((end - begin)) s"
echo "of the processor, user and system: apt $(tail -1 "$out/apt.times"), the run $(tail -1 "$out/run.times")"
inside sh -c 'cd /tmp && flexneck run cantilever -q -o bar && test -s bar/report.html'
test -s "$root/usr/share/man/man1/flexneck.1"
test -s "$root/usr/share/bash-completion/completions/flexneck"

echo '== Python'
cp "$sources/tests/pipeline/python/documented_test.py" "$sources/tests/pipeline/exchange/fmu/fmu_test.py" "$root/tmp"
inside sh -c 'apt-get install -y --no-install-recommends /tmp/python3-flexneck_*.deb' >"$out/apt-python.log" 2>&1
inside sh -c 'cd /usr/share/doc/python3-flexneck/examples && test -s ../README.md &&
  for each in [!p]*.py p[!l]*.py; do python3 -B "$each" /tmp/drawn || exit 1; done' >"$out/python.log" 2>&1
tail -3 "$out/python.log"
inside python3 -B /tmp/documented_test.py
inside python3 -B /tmp/fmu_test.py flexneck four_bar Formulas
inside sh -c 'cd /tmp && python3 -c "import flexneck as fn; \
fn.Study(\"hybrid3\").mesh(\"py\").modes().pendulum(\"flexion-20\")" && \
  flexneck mesh hybrid3 -q -o cmd && flexneck modes hybrid3 -q -o cmd && \
  flexneck pendulum hybrid3 -q --case flexion-20 -o cmd && \
  cmp py/pendulum-flexion-20.h5 cmd/pendulum-flexion-20.h5'

echo '== the consumer'
inside sh -c 'apt-get install -y --no-install-recommends /tmp/libflexneck-dev_*.deb cmake g++ make' \
  >"$out/apt-dev.log" 2>&1
inside sh -c 'cd /tmp && cmake -S consumer -B built && cmake --build built && built/pendulum' \
  >"$out/consumer.log" 2>&1
tail -2 "$out/consumer.log"
umount "$root/proc" "$root/sys"
trap - EXIT
rm -rf "$root"
