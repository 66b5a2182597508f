# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# Steps of a script that takes minutes: their headings, times and exit status. Sourced by launch/demo and tests/run.
#
# The script sets `phase_script` and `phase_count` before, calls `phase` for each step, and ends with `end_phases`.
# A signal to the script alone reaches the running command too, so that nothing is left running.

phase_script=${phase_script:-${0##*/}}
phase_count=${phase_count:-1}
phase_number=0
phase_times=()    # "build 8 min 3 s", in their order
phase_failed=     # "build", if that step has failed
phase_signal=     # the signal that ended the script
phase_child=

# Standard input may be closed; a command that inherits it needs one that is open.
{ : <&0; } 2>/dev/null || exec </dev/null

# duration SECONDS: "8 s", "2 min 10 s", "1 h 5 min".
duration() {
  if [ "$1" -lt 60 ]; then
    echo "$1 s"
  elif [ "$1" -lt 3600 ]; then
    echo "$(($1 / 60)) min $(($1 % 60)) s"
  else
    echo "$(($1 / 3600)) h $(($1 % 3600 / 60)) min"
  fi
}

_phase_interrupted() {
  phase_signal=$1
  [ -z "$phase_child" ] || kill -s "${1/PIPE/TERM}" "$phase_child" 2>/dev/null || true
}
for signal in INT TERM HUP PIPE; do
  # shellcheck disable=SC2064  # the signal's name is meant as it is now
  trap "_phase_interrupted $signal" "$signal"
done

# Runs a command of this process group and returns its exit status. Traps run at once: for a foreground command they
# would wait until it ends.
run_child() {
  local status=0
  # A background command of a script ignores SIGINT and has no standard input: both are given back.
  env --default-signal=INT,QUIT "$@" <&0 &
  phase_child=$!
  wait "$phase_child" || status=$?
  while kill -0 "$phase_child" 2>/dev/null; do  # `wait` was interrupted by a signal
    status=0
    wait "$phase_child" || status=$?
  done
  phase_child=
  return "$status"
}

# phase NAME COMMAND [ARGUMENT…]: one step. Returns the command's exit status.
phase() {
  local name=$1 began=$SECONDS status=0
  shift
  phase_number=$((phase_number + 1))
  echo "$phase_script: step $phase_number of $phase_count: $name"
  run_child "$@" || status=$?
  [ -z "$phase_signal" ] || [ "$status" -ne 0 ] || status=130
  phase_times+=("$name $(duration $((SECONDS - began)))")
  [ "$status" -eq 0 ] || phase_failed=$name
  return "$status"
}

# end_phases STATUS: prints the time of each step and which one has failed. `exit_phases STATUS` then ends the script.
end_phases() {
  local times word='done'
  printf -v times '%s, ' "${phase_times[@]}"
  if [ -n "$phase_signal" ]; then
    word="interrupted in step $phase_number of $phase_count ($phase_failed)"
  elif [ -n "$phase_failed" ]; then
    word="step $phase_number of $phase_count ($phase_failed) failed with exit status $1"
  fi
  echo "$phase_script: $word: ${times%, }"
}
exit_phases() {
  if [ -n "$phase_signal" ]; then
    trap - "$phase_signal"
    kill -s "$phase_signal" $$
  fi
  exit "$1"
}
