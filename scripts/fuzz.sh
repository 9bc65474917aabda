#!/usr/bin/env bash
# Runs every fuzz target over the inputs of tests/fuzz/TARGET and what is made from them, two at a time.
#   scripts/fuzz.sh                 a fixed seed and a fixed number of runs: the same in every run
#   scripts/fuzz.sh --each SECONDS  random seeds, from a corpus that grows in build/fuzz/corpus
# A finding ends with its input kept in build/fuzz: put it into tests/fuzz/TARGET, which ctest runs.
set -euo pipefail
cd "$(dirname "$0")/.."
targets=(build/asan-ubsan/fuzz/*_fuzz)
if [ "${1:-}" = --each ]; then
  limits="-max_total_time=$2"
  echo "${#targets[@]} targets, $2 s each, random seeds"
else
  limits="-seed=1 -runs=${CUTICLE_FUZZ_RUNS:-20000}"
  echo "${#targets[@]} targets, $limits"
fi
mkdir -p build/fuzz
run_one() {
  name=$(basename "$1")
  grown=build/fuzz/corpus/$name
  [ -n "${2##*seed=*}" ] || grown=$(mktemp -d build/fuzz/fresh-XXXXXX)
  mkdir -p "$grown" "tests/fuzz/$name"
  status=0
  # shellcheck disable=SC2086
  "$1" $2 -max_len=65536 -rss_limit_mb=2048 -timeout=10 -print_final_stats=1 -artifact_prefix="build/fuzz/$name-" "$grown" \
      "tests/fuzz/$name" >"build/fuzz/$name.log" 2>&1 || status=$?
  case $grown in build/fuzz/fresh-*) rm -r "$grown" ;; esac
  if [ $status != 0 ]; then
    tail -40 "build/fuzz/$name.log"
    echo "FINDING in $name: the input is build/fuzz/$name-*"
    return 1
  fi
  grep -E 'stat::number_of_executed_units' "build/fuzz/$name.log" | sed "s/^/$name: /"
}
export -f run_one
printf '%s\n' "${targets[@]}" | xargs -P 2 -I{} bash -c "run_one {} '$limits'"
