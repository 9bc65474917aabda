#!/usr/bin/env bash
# Small runs of the program under valgrind, which finds what is read before it was written: scripts/valgrind.sh
# Wants the preset `release` and valgrind. The processor is asked for AVX2 at most: valgrind knows no AVX-512.
set -euo pipefail
cd "$(dirname "$0")/.."
program=$PWD/build/release/bin/cuticle
folder=$(mktemp -d)
trap 'rm -r "$folder"' EXIT
check() {
  echo "cuticle $*"
  valgrind -q --error-exitcode=99 "$program" "$@" >"$folder/out" 2>"$folder/err" ||
      { status=$?; cat "$folder/err"; [ $status != 99 ] || echo "valgrind: cuticle $*"; exit 1; }
}
cat >"$folder/points.csv" <<'CSV'
theta_i,theta_o,phi
10,20,30
-80,85,179
CSV
check eval --model all --points "$folder/points.csv" --precision f32
check eval --model marschner,chiang,deon --quantity S --theta-i -90:90:7 --theta-o 0 --phi 0:180:5
check grow --share 0.002 --out "$folder/hair.npz"
for format in hair usda vtp ply tfx pbrt data txt; do
  check convert "$folder/hair.npz" "$folder/copy.$format"
  check info "$folder/copy.$format"
done
check bake --model marschner --size 16 --out "$folder/tables"
check check lut "$folder/tables"
echo "all without an error"
