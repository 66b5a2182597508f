#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Installs Rodeira from this folder, without a network: sudo ./install.sh [PACKAGE]…   (default: rodeira)
set -eu
here=$(cd "$(dirname "$0")" && pwd)
if [ "$(id -u)" -ne 0 ]; then
  echo "install.sh: root is needed: sudo $0 $*" >&2
  exit 1
fi
if [ ! -f "$here/debian/Packages" ]; then
  echo "install.sh: $here/debian/Packages: no such file; copy the whole folder" >&2
  exit 2
fi
[ $# -gt 0 ] || set -- rodeira
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# apt reads as its own user, which may not enter a home directory: the index is read by root.
mkdir -p "$work/lists/partial"
echo "deb [trusted=yes] file:$here/debian ./" >"$work/sources.list"
apt_here() {
  apt-get -q -o Dir::Etc::SourceList="$work/sources.list" -o Dir::Etc::SourceParts=/dev/null \
    -o Dir::State::Lists="$work/lists" -o APT::Sandbox::User=root \
    -o Dir::Cache::pkgcache= -o Dir::Cache::srcpkgcache= "$@"
}
apt_here update
DEBIAN_FRONTEND=noninteractive apt_here install -y --no-install-recommends "$@"
echo "installed: $*; next: rodeira doctor, then: rodeira run demo"
