#!/usr/bin/env bash
# The figures of docs/findings.md, from what `cuticle study all --out DIR` wrote: scripts/findings_figures.sh DIR.
set -euo pipefail
cd "$(dirname "$0")/.."
mkdir -p docs/figures
for figure in luts/luts-marschner shadows/shadows-coat motion/motion-head-turn motion/motion-curl motion/motion-contact lobes/lobes-all-models \
  picture/picture-blond picture/picture-curls picture/picture-fur render/render-near; do
  cp "$1/$figure.svg" "docs/figures/$(basename "$figure").svg"
done
