#!/usr/bin/env bash
# Runs the device's code with instrumented shaders: the validation layer then names reads and writes past the end of a buffer,
# and descriptors that are not there.
#   scripts/gpu_assisted_validation.sh [FAMILY ...]    the hard cases of these families, of all without one (cuticle check device)
#   scripts/gpu_assisted_validation.sh -R REGEX        tests of the preset `release`
# Wants the preset `release`. First it proves that the instrumentation is on: a kernel writes past its buffer and must be named.
set -euo pipefail
cd "$(dirname "$0")/.."
export VK_LAYER_ENABLES=VK_VALIDATION_FEATURE_ENABLE_GPU_ASSISTED_EXT
proof=$(CUTICLE_VALIDATION=1 CUTICLE_DEVICE=cpu build/release/tests/gpu_kernel_test --gtest_filter='GpuValidation.WritePastABuffer*' 2>&1) ||
    { echo "$proof"; exit 1; }
if grep -q SKIPPED <<<"$proof"; then
  echo "GPU-assisted validation is off on this machine"
  exit 1
fi
if [ "${1:-}" = -R ]; then exec ctest --preset release -j2 "$@"; fi
export CUTICLE_VALIDATION=1
[ $# != 0 ] || set -- functions engine_models fibre_models marschner tables strands shadows motion drawing
for family in "$@"; do
  build/release/bin/cuticle --device cpu check device --family "$family" | tail -2
done
