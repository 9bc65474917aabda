#!/usr/bin/env bash
# Runs every fuzz target over the inputs of tests/fuzz/TARGET and what is made from them, two at a time (CUTICLE_FUZZ_JOBS).
#   scripts/fuzz.sh                 a fixed seed and a fixed number of runs: the same in every run
#   scripts/fuzz.sh --each SECONDS  random seeds, from a corpus that grows in build/fuzz/corpus; build/fuzz/report.txt gets
#                                   a line for each target: seed, inputs run, processor time, finding or none
# A finding ends with its input kept in build/fuzz: put it into tests/fuzz/TARGET, which ctest runs.
set -euo pipefail
cd "$(dirname "$0")/.."
targets=(build/asan-ubsan/fuzz/*_fuzz)
each=${2:-}
if [ "${1:-}" = --each ]; then
  echo "${#targets[@]} targets, $each s each, random seeds"
else
  echo "${#targets[@]} targets, seed 1, ${CUTICLE_FUZZ_RUNS:-20000} runs"
fi
mkdir -p build/fuzz
: >build/fuzz/report.txt
run_one() {
  name=$(basename "$1")
  if [ -n "$2" ]; then
    seed=$(od -An -N4 -tu4 /dev/urandom | tr -d ' ')
    limits="-max_total_time=$2 -timeout=60"
    grown=build/fuzz/corpus/$name
  else
    seed=1
    limits="-runs=${CUTICLE_FUZZ_RUNS:-20000} -timeout=10"
    grown=$(mktemp -d build/fuzz/fresh-XXXXXX)
  fi
  mkdir -p "$grown" "tests/fuzz/$name"
  log=build/fuzz/$name.log
  status=0
  TIMEFORMAT='processor seconds: %U'
  # shellcheck disable=SC2086
  { time "$1" $limits -seed=$seed -max_len=65536 -rss_limit_mb=2048 -print_final_stats=1 -artifact_prefix="build/fuzz/$name-" "$grown" \
      "tests/fuzz/$name"; } >"$log" 2>&1 || status=$?
  case $grown in build/fuzz/fresh-*) rm -r "$grown" ;; esac
  executed=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
  processor=$(sed -n 's/^processor seconds: //p' "$log")
  found=none
  [ $status = 0 ] || found=FINDING
  printf '%-18s seed %-10s  inputs %-9s  processor %6.0f s  finding: %s\n' "$name" "$seed" "$executed" "$processor" $found |
      tee -a build/fuzz/report.txt
  if [ $status != 0 ]; then
    tail -40 "$log"
    echo "FINDING in $name: the input is build/fuzz/$name-*"
    return 1
  fi
}
export -f run_one
printf '%s\n' "${targets[@]}" | xargs -P "${CUTICLE_FUZZ_JOBS:-2}" -I{} bash -c "run_one {} '$each'"
