"""Whether a batch of points from numpy arrays costs what it costs in C++.

    nice -n 0 .venv/bin/python bench/batch.py [--models karis,chiang] [--rounds 5]

In turn, round after round: bench_bsdf (C++, one thread, the widest instruction set) and cuticle.Batch.eval on arrays of 16,384 points with `out` given, one
thread, both as the best of many runs. Prints ns a point of each and the median over the rounds of their ratio; the goal is 1.10 at most.
"""
import argparse
import json
import pathlib
import statistics
import subprocess
import sys
import time

import numpy

import cuticle

ROOT = pathlib.Path(__file__).resolve().parents[1]
POINTS = 16384


def of_cpp(model, program):
    """ns a point of S for the default settings, by arrays on the widest instruction set."""
    told = json.loads(subprocess.run([program, "--models", model, "--format", "json"], capture_output=True, text=True, check=True).stdout)
    rows = [row for row in told["rows"] if row["task"] == "S" and row["settings"] == "" and row["path"] not in ("scalar",) and "point" not in row["path"]]
    return min(row["ns"] for row in rows) if rows else None


def directions(random):
    s, phi = random.uniform(-1, 1, POINTS), random.uniform(0, 2 * numpy.pi, POINTS)
    c = numpy.sqrt(1 - s * s)
    return numpy.array([s, c * numpy.cos(phi), c * numpy.sin(phi)], numpy.float32)


def of_python(batch, arrays, out):
    best = float("inf")
    for _ in range(400):
        began = time.process_time_ns()
        batch.eval(*arrays, out=out)
        best = min(best, time.process_time_ns() - began)
    return best / POINTS


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--models", default="karis,chiang,marschner,kajiya_kay,hairworks")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--program", default=ROOT / "build/release/bin/bench_bsdf")
    options = parser.parse_args()
    cuticle.set_threads(1)
    random = numpy.random.default_rng(7)
    light, viewer, h, out = directions(random), directions(random), random.uniform(-1, 1, POINTS).astype(numpy.float32), numpy.empty((3, POINTS), numpy.float32)
    worst = 0
    for model in options.models.split(","):
        batch = cuticle.Batch(model)
        pairs = [(of_cpp(model, options.program), of_python(batch, (light, viewer, h), out)) for _ in range(options.rounds)]
        if pairs[0][0] is None:
            print(f"{model}: not vectorised")
            continue
        ratio = statistics.median(there / here for here, there in pairs)
        worst = max(worst, ratio)
        print(f"{model}: C++ {min(p[0] for p in pairs):.2f} ns a point, numpy {min(p[1] for p in pairs):.2f}, ratio {ratio:.3f} "
              f"({', '.join(f'{there / here:.3f}' for here, there in pairs)})", flush=True)
    print(f"largest ratio {worst:.3f}: {'within' if worst <= 1.1 else 'past'} 1.10")
    return 0 if worst <= 1.1 else 1


if __name__ == "__main__":
    sys.exit(main())
