#!/usr/bin/env bash
# The tests: scripts/test.sh [--ci | --full]. Builds `release` and runs its tests, but for those with the label `long`. --ci adds
# these and what else continuous integration runs: the CPU tests under ASan + UBSan, and the fuzzers of every reader (the same
# inputs in every run). --full adds to that fuzzing of each for 10 minutes from random seeds, the sweeps under sanitizers,
# ThreadSanitizer, valgrind, GPU-assisted validation and the presets `minimal`, `double` and `dev`.
set -euo pipefail
cd "$(dirname "$0")/.."
parts=${1:-release}
some=()
case $parts in
  release) some=(--label-exclude '^long$') ;;
  --ci) ;;
  --full) export CUTICLE_SWEEPS=ON ;;
  *) echo "test.sh: unknown option $parts: expected --ci or --full, or none" >&2 && exit 2 ;;
esac
started=$SECONDS
say() { printf '\n== %s (%d s)\n' "$1" $((SECONDS - started)); }

scripts/setup.sh
say "build release"
scripts/build.sh release
say "tests of release"
ctest --preset release -j2 ${some[@]:+"${some[@]}"} --output-junit "$PWD/build/release/report.xml"
say "rows of docs/systems.md that ran and passed"
scripts/coverage-of-systems

if [ $parts != release ]; then
  say "build asan-ubsan"
  scripts/build.sh asan-ubsan all_tests all_fuzz_targets
  say "tests of asan-ubsan"
  # intercept_tls_get_addr: up to LLVM 16 the runtime takes a thread's block that begins 16 bytes after a page for one with the
  # header of glibc 2.19, reads its address and length from whatever stands there, and the search for leaks may die of it.
  export ASAN_OPTIONS=detect_leaks=1:intercept_tls_get_addr=0
  LSAN_OPTIONS=suppressions="$PWD/cmake/leaks.supp" UBSAN_OPTIONS=print_stacktrace=1 ctest --preset asan-ubsan -j2
  say "fuzzing"
  scripts/fuzz.sh
fi

if [ $parts = --full ]; then
  scripts/fuzz.sh --each 600
  say "valgrind"
  scripts/valgrind.sh
  say "GPU-assisted validation"
  scripts/gpu_assisted_validation.sh
  say "ThreadSanitizer"
  scripts/thread_sanitizer.sh
  for preset in minimal double dev; do
    say "build and tests of $preset"
    scripts/build.sh $preset
    ctest --preset $preset -j2
  done
fi
say "all passed"
