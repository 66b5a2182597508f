# shellcheck shell=bash disable=SC2154
# SPDX-License-Identifier: Apache-2.0
# For scripts that write pages by doxygen. Before sourcing: root (the repository), doxygen_script (name of the script),
# doxygen_folder (default of --out, relative to root).

# read_doxygen_options OPTION…: sets doxygen_check (yes or no) and doxygen_out (a folder, or nothing with --check).
# Goes to the root. Ends the script with 2 for a wrong option, 77 where doxygen is missing.
read_doxygen_options() {
  doxygen_check=no
  doxygen_out=
  while [ $# -gt 0 ]; do
    case "$1" in
      --check) doxygen_check=yes ;;
      --out)
        if [ -z "${2:-}" ]; then
          echo "$doxygen_script: --out has no value; a folder was expected" >&2
          exit 2
        fi
        doxygen_out=$2
        shift ;;
      *)
        echo "$doxygen_script: unknown option '$1'; expected --check or --out FOLDER" >&2
        exit 2 ;;
    esac
    shift
  done
  if [ "$doxygen_check" = yes ] && [ -n "$doxygen_out" ]; then
    echo "$doxygen_script: --check writes no pages; expected --check or --out FOLDER, not both" >&2
    exit 2
  fi
  if ! command -v doxygen >/dev/null; then
    echo "$doxygen_script: skipped: doxygen is missing; as root: apt-get install doxygen" >&2
    exit 77
  fi
  [ "$doxygen_check" = yes ] || doxygen_out=$(realpath -m "${doxygen_out:-$root/$doxygen_folder}")
  cd "$root" || exit 1
  doxygen_work=$(mktemp -d)
  trap 'rm -rf "$doxygen_work"' EXIT
}

# run_doxygen SETTINGS…: writes the pages by these settings, in addition the lines of standard input. With --check the
# pages go to a folder that is removed: only with pages doxygen reads the text of all comments. Ends the script with 1
# if doxygen fails, with --check also if it warns.
run_doxygen() {
  mkdir -p "${doxygen_out:-$doxygen_work/html}"
  {
    cat "$@" -
    sed -n 's/^project(rodeira VERSION \([0-9.]*\).*/PROJECT_NUMBER = \1/p' CMakeLists.txt
    echo "WARN_LOGFILE = \"$doxygen_work/warnings\""
    echo "OUTPUT_DIRECTORY = \"${doxygen_out:-$doxygen_work/html}\""
  } >"$doxygen_work/Doxyfile"
  touch "$doxygen_work/warnings"
  if ! doxygen "$doxygen_work/Doxyfile" >"$doxygen_work/log" 2>&1; then
    cat "$doxygen_work/log" "$doxygen_work/warnings" >&2
    exit 1
  fi
  if [ -s "$doxygen_work/warnings" ]; then
    echo "$doxygen_script: doxygen warns:" >&2
    sed "s|^$root/||; s|^$doxygen_work/headers/||" "$doxygen_work/warnings" >&2
    [ "$doxygen_check" = no ] || exit 1
  fi
}
