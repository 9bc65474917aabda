#!/usr/bin/env bash
# Runs every fuzz target: scripts/fuzz.sh SECONDS_IN_TOTAL | --each SECONDS. Two at a time; a finding ends with its input
# kept in build/fuzz.
set -euo pipefail
cd "$(dirname "$0")/.."
targets=(build/asan-ubsan/fuzz/*_fuzz)
if [ "$1" = --each ]; then each=$2; else each=$(($1 / ${#targets[@]})); fi
[ "$each" -ge 1 ] || each=1
echo "${#targets[@]} targets, $each s each"
run_one() {
  name=$(basename "$1")
  mkdir -p "build/fuzz/corpus/$name"
  if ! "$1" -max_total_time="$2" -rss_limit_mb=2048 -timeout=10 -print_final_stats=1 -artifact_prefix="build/fuzz/$name-" \
      "build/fuzz/corpus/$name" >"build/fuzz/$name.log" 2>&1; then
    tail -40 "build/fuzz/$name.log"
    echo "FINDING in $name: the input is build/fuzz/$name-*"
    return 1
  fi
  grep -E 'stat::number_of_executed_units' "build/fuzz/$name.log" | sed "s/^/$name: /"
}
export -f run_one
printf '%s\n' "${targets[@]}" | xargs -P 2 -I{} bash -c "run_one {} $each"
