# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# For the tests of scripts: stand-ins, and what a command has printed. Sourced with the folder of the scripts as $1.
# shellcheck disable=SC2034,SC2030,SC2031  # used by the scripts that source this; counted again by side_by_side
tools=$1
folder=$(mktemp -d "${TMPDIR:-/tmp}/rodeira-tools-test-XXXXXX")
trap 'rm -rf "$folder"' EXIT
export RODEIRA_PROGRESS_S=1
failures=0
printed=
status=0

# stand_in NAME: standard input becomes a program of this name, first in PATH.
mkdir "$folder/bin"
PATH=$folder/bin:$PATH
stand_in() {
  { echo '#!/usr/bin/env bash'; cat; } >"$folder/bin/$1"
  chmod +x "$folder/bin/$1"
}

# run COMMAND…: keeps what is printed and the exit status; no terminal, no standard input.
run() {
  status=0
  printed=$("$@" 2>&1 </dev/null) || status=$?
}

fail() {
  failures=$((failures + 1))
  printf 'FAILED: %s\nprinted, with exit status %s:\n%s\n\n' "$1" "$status" "$printed"
}
has() { [[ $printed =~ $1 ]] || fail "no match for: $1"; }
has_not() { [[ ! $printed =~ $1 ]] || fail "unexpected match for: $1"; }
ends_with() { [ "$status" -eq "$1" ] || fail "exit status $1 was expected"; }

# side_by_side CHECK…: functions that mostly wait, each in a process of its own; what each has printed follows in order.
side_by_side() {
  local check pids=() number=0
  for check in "$@"; do
    (
      failures=0
      "$check"
      exit "$((failures > 0))"
    ) >"$folder/$check.printed" 2>&1 &
    pids+=("$!")
  done
  for check in "$@"; do
    wait "${pids[number]}" || failures=$((failures + 1))
    cat "$folder/$check.printed"
    number=$((number + 1))
  done
}

finish() {
  if [ "$failures" -gt 0 ]; then
    echo "$failures checks failed"
    exit 1
  fi
  echo "all checks passed"
}
