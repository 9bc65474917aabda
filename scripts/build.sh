#!/usr/bin/env bash
# Configures and builds a preset: scripts/build.sh PRESET [TARGET ...].
set -euo pipefail
cd "$(dirname "$0")/.."
preset=$1
shift
export PATH="$PWD/.venv/bin:$PATH"
# With ccache, clones in other folders share what they compiled.
export CCACHE_BASEDIR="$PWD" CCACHE_NOHASHDIR=1 CCACHE_SLOPPINESS=pch_defines,time_macros
log=build/$preset.configure.log
mkdir -p build
cmake --preset "$preset" >"$log" 2>&1 || { cat "$log" >&2; exit 1; }
cmake --build --preset "$preset" -- --quiet ${@:+"$@"}
