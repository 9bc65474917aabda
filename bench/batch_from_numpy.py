"""What cuticle.Batch costs from numpy beside the same batch in C++ (bench_bsdf), one thread, in one run.

    .venv/bin/python bench/batch_from_numpy.py [--models karis,chiang] [--rounds 5]

The two take turns. The least time of each counts: what other work adds is not the arrays' doing.
"""
import argparse
import json
import pathlib
import subprocess
import sys
import time

import cuticle
import numpy

POINTS = 16384  # as many as bench_bsdf takes
PROGRAM = pathlib.Path(__file__).parent.parent / "build/release/bin/bench_bsdf"


def unit_vectors(random):
    vectors = random.normal(size=(3, POINTS))
    return (vectors / numpy.linalg.norm(vectors, axis=0)).astype(numpy.float32)


def from_cpp(model):
    """Nanoseconds a point of S through arrays, with the widest instructions."""
    rows = json.loads(subprocess.run([PROGRAM, "--models", model, "--format", "json"], check=True, capture_output=True, text=True).stdout)
    rows = rows["rows"] if isinstance(rows, dict) else rows
    return min(row["ns"] for row in rows if row["task"] == "S" and row["path"] in ("baseline", "avx2", "avx512"))


def from_numpy(batch, light, viewer, h, out):
    """The same from numpy: the least mean of a fifth of a second."""
    least = float("inf")
    for _ in range(40):
        begin, calls = time.perf_counter(), 0
        while time.perf_counter() - begin < 0.01:
            for _ in range(8):
                batch.eval(light, viewer, h, out=out)
            calls += 8
        least = min(least, (time.perf_counter() - begin) / calls / POINTS * 1e9)
    return least


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--models", default="karis,chiang,marschner,kajiya_kay")
    parser.add_argument("--rounds", type=int, default=3)
    arguments = parser.parse_args()
    cuticle.set_threads(1)
    random = numpy.random.default_rng(7)
    light, viewer, h = unit_vectors(random), unit_vectors(random), random.uniform(-1, 1, POINTS).astype(numpy.float32)
    worst = 0.0
    for model in arguments.models.split(","):
        batch, out = cuticle.Batch(model, "field=near" if model == "chiang" else None), numpy.empty((3, POINTS), numpy.float32)
        pairs = [(from_cpp(model), from_numpy(batch, light, viewer, h, out)) for _ in range(arguments.rounds)]
        cpp, python = (min(pair[side] for pair in pairs) for side in (0, 1))
        worst = max(worst, python / cpp)
        print(f"{model}: C++ {cpp:.2f} ns a point, numpy {python:.2f} ns, ratio {python / cpp:.3f}", flush=True)
    return 0 if worst <= 1.1 else 1


if __name__ == "__main__":
    sys.exit(main())
