"""Values of our models by the program `cuticle` (environment variable CUTICLE; else build/release/bin/cuticle)."""
import csv
import os
import subprocess
import tempfile

import numpy as np


def evaluate(model, settings, quantity, lobe="sum", **columns):
    """Red, green, blue of one quantity at points; columns: theta_i, theta_o, phi, h, ... in degrees, arrays of one length."""
    names = list(columns)
    rows = np.column_stack([np.atleast_1d(np.asarray(columns[name], float)) for name in names])
    with tempfile.NamedTemporaryFile("w", suffix=".csv") as file:
        file.write(",".join(names) + "\n")
        np.savetxt(file, rows, delimiter=",", fmt="%.12g")
        file.flush()
        program = os.environ.get("CUTICLE", "build/release/bin/cuticle")
        made = subprocess.run([program, "eval", "--model", model, "--set", settings, "--quantity", quantity, "--lobe", lobe, "--points", file.name],
                              capture_output=True, text=True, check=True)
    table = csv.DictReader(line for line in made.stdout.splitlines() if not line.startswith("#"))
    return np.array([[float(row[c]) for c in "rgb"] for row in table])


def summary(name, ours, theirs):
    """Rms of the difference over the rms, the largest over the peak, and the ratio of the means."""
    ours, theirs = np.asarray(ours, float), np.asarray(theirs, float)
    off = ours - theirs
    rms = np.sqrt((off**2).mean() / (theirs**2).mean())
    print(f"{name:52s} rms {rms:.2e}   largest / peak {abs(off).max() / theirs.max():.2e}   mean ours / theirs {ours.mean() / theirs.mean():.5f}", flush=True)
