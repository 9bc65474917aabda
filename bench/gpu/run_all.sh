#!/usr/bin/env bash
# Measures what a GPU is asked for, on a machine that has nothing but a driver: run_all.sh SOURCES OUT [parity|goals|all].
# SOURCES: the checkout whose programs pack.py packed (tests read files of it). OUT receives results.txt, which begins
# with the device's name, and a log for each test.
set -uo pipefail
here=$(cd "$(dirname "$0")" && pwd)
sources=$(cd "$1" && pwd)
mkdir -p "$2/parity"
out=$(cd "$2" && pwd)
what=${3:-all}
export LD_LIBRARY_PATH="$here/lib${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}" PATH="$here/bin:$PATH"
export VK_LAYER_PATH="$here/lib"
export CUTICLE_DEVICE=gpu CUTICLE_TEST_DATA="$here/data"

# Tests name files by the path that the checkout had where they were built.
built_at=$(cat "$here/sources.txt")
[ -e "$built_at" ] || { mkdir -p "$(dirname "$built_at")" && ln -s "$sources" "$built_at"; }

# Runs one line of tests.txt: NAME PROGRAM FOLDER.
run_test() {
  local folder="$here/work/$1" begin=$SECONDS
  mkdir -p "$folder" && cd "$folder" || exit
  if timeout 120 "$here/tests/$2" >"$out/parity/$1.log" 2>&1; then verdict=passed; else verdict="FAILED ($?)"; fi
  echo "$1 $verdict $((SECONDS - begin)) s"
}
export -f run_test
export here out

parity() {
  echo "## Tests of the device, $(wc -l <"$here/tests.txt") programs"
  timeout 140 cuticle check device --certificate "$out/certificate.json" >"$out/check.txt" 2>&1 &
  xargs -P "$(($(nproc) / 3 + 1))" -L 1 bash -c 'run_test "$@"' _ <"$here/tests.txt" | sort
  wait
  tail -n 14 "$out/check.txt"
  grep -h '^\[  FAILED  \] [A-Z]' "$out"/parity/*.log | sed 's/ (.*//' | sort -u
}

goals() {
  echo "## Goals"
  timeout 150 bench_gpu 1 "$out"
}

{
  date -u +%F
  nvidia-smi --query-gpu=name,driver_version --format=csv,noheader 2>/dev/null
  grep -m 1 'model name' /proc/cpuinfo
  [ "$what" = goals ] || parity
  [ "$what" = parity ] || goals
} 2>&1 | tee "$out/results.txt"
