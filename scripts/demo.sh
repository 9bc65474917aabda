#!/usr/bin/env bash
# The main job on a fresh machine: set up, build, run `cuticle demo`. Arguments go to it (--groom FILE, --out DIR).
# Afterwards `.venv/bin/python -c "import cuticle"` works too.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/setup.sh
scripts/build.sh release cuticle _cuticle
exec build/release/bin/cuticle demo "$@"
