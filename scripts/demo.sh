#!/usr/bin/env bash
# The main job on a fresh machine: set up, build, run `cuticle demo`. Arguments go to it (--groom FILE, --out DIR).
# Says how long each took. Afterwards `.venv/bin/python -c "import cuticle"` works too.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/setup.sh
set_up=$SECONDS
scripts/build.sh release cuticle _cuticle
built=$SECONDS
build/release/bin/cuticle demo "$@"
echo "demo.sh: set up in $set_up s, built in $((built - set_up)) s, demo in $((SECONDS - built)) s, $SECONDS s in all" >&2
