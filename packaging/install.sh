#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Installs Rodeira from this folder, without a network: sudo ./install.sh [--downgrade] [PACKAGE]…
#
#   PACKAGE       default: rodeira
#   --downgrade   also where this PC has a newer version of a package that is needed exactly as it is in this folder
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
downgrade=
if [ "${1:-}" = --downgrade ]; then
  downgrade=--allow-downgrades
  shift
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
    -o Dir::Etc::Preferences="$work/preferences" -o Dir::Cache::pkgcache= -o Dir::Cache::srcpkgcache= "$@"
}
# Of packages that are in this folder and newer on this PC: name, version here, version on this PC.
newer_on_this_pc() {
  awk '$1 == "Package:" { name = $2 } $1 == "Version:" { print name, $2 }' "$here/debian/Packages" |
    while read -r name version; do
      installed=$(dpkg-query -W -f '${db:Status-Abbrev} ${Version}\n' "$name" 2>/dev/null |
        awk '/^ii/ { print $2; exit }')
      if [ -n "$installed" ] && dpkg --compare-versions "$installed" gt "$version"; then
        echo "  $name: $version in this folder, $installed on this PC"
      fi
    done
}
: >"$work/preferences"
[ -z "$downgrade" ] || printf 'Package: *\nPin: origin ""\nPin-Priority: 1001\n' >"$work/preferences"
apt_here update
DEBIAN_FRONTEND=noninteractive apt_here install -y --no-install-recommends $downgrade "$@" || {
  newer=$(newer_on_this_pc)
  [ -n "$newer" ] || exit 1
  echo "install.sh: $* cannot be installed; this PC has newer versions of packages in this folder:" >&2
  echo "$newer" >&2
  echo "Make the folder again (tools/package --offline), or take its versions: sudo $0 --downgrade $*" >&2
  exit 1
}
echo "installed: $*; next: rodeira doctor, then: rodeira run demo"
