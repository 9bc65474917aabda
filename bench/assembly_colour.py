"""The colour of a dense ball of hair under a white sky, by the path tracer, beside a fibre's albedo and the fit of Chiang et al. 2016.

  pip install -r bench/requirements.txt
  export CUTICLE=build/release/bin/cuticle
  python bench/assembly_colour.py OUT [--model chiang] [--set beta_m=0.3,beta_n=0.3] [--absorption 0.003,0.03,0.3] [--samples 64]

Each picture has three absorptions, as its three colours. Prints as CSV, for each absorption per radius: the albedo of the fibre seen from across, the
colour of the ball (of the middle of its disc, .8 of the radius), its standard error, and the colour of which absorption_of_assembly makes that absorption.
"""
import argparse
import json
import os
import subprocess

import numpy as np
import OpenEXR

import against_reference
import measured_scenes

BALL, RADIUS, LENGTH, FIBRES = 0.1, 5e-4, 0.08, 12000  # metres; some 40 fibres lie behind each other in the middle
SIZE = 40


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("out")
    parser.add_argument("--model", default="chiang")
    parser.add_argument("--set", default="")
    parser.add_argument("--absorption", default="0.002,0.006,0.02,0.06,0.12,0.25,0.5,1,3")
    parser.add_argument("--samples", type=int, default=64)
    return parser.parse_args()


def ball(path):
    """Straight fibres, their middles even in a ball, their directions even."""
    random = np.random.default_rng(1)
    directions, middles = (random.normal(size=(FIBRES, 3)) for _ in range(2))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    middles *= BALL * random.random((FIBRES, 1)) ** (1 / 3) / np.linalg.norm(middles, axis=1, keepdims=True)
    ends = np.stack([middles - LENGTH / 2 * directions, middles + LENGTH / 2 * directions], 1)
    np.savez(path, offsets=np.arange(FIBRES + 1, dtype=np.uint32) * 2, positions=ends.reshape(-1, 3).astype(np.float32),
             radii=np.full(2 * FIBRES, RADIUS, np.float32))


def sky(path):
    white = {name: np.ones((8, 16), np.float32) for name in "RGB"}
    with OpenEXR.File({"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}, white) as file:
        file.write(path)


def settings_of(text):
    return {name: float(value) for name, value in (part.split("=") for part in text.split(",") if part)}


def albedos(options, sigma_a):
    text = ",".join([f"sigma_a={'/'.join(map(str, sigma_a))}", *([options.set] if options.set else [])])
    done = subprocess.run([measured_scenes.PROGRAM, "eval", "--model", options.model, "--set", text, "--quantity", "albedo",
                           "--theta-o", "0", "--json"], capture_output=True, text=True, check=True)
    row = json.loads(done.stdout)[0]
    return [row[channel] for channel in "rgb"]


def shown(options, files, sigma_a, out):
    """Mean radiance of the disc's middle, and its standard error over four parts of it."""
    groom, surroundings = files
    scene = {
        "schema_version": 1, "name": "ball", "groom": {"file": groom, "metres_per_unit": 1, "radius_m": RADIUS, "taper": 0},
        "head": {"present": False}, "environment": {"file": surroundings},
        "material": {"model": {options.model: {**settings_of(options.set), "sigma_a": list(sigma_a)}}},
        "camera": {"position_m": [0, 0, 2], "target_m": [0, 0, 0], "fov_deg": 6.5, "resolution_px": [SIZE, SIZE]},
        "passes": {"resolve": {"background": [0, 0, 0]}},
    }
    picture = against_reference.render(scene, out, "--method", "reference", "--samples", str(options.samples))
    away = np.hypot(*(np.mgrid[:SIZE, :SIZE] - (SIZE - 1) / 2)) * 2 * 2 * np.tan(np.radians(3.25)) / SIZE
    middle = (away < 0.8 * BALL) & (picture[..., 3] > 0.999)
    parts = np.array([picture[middle][k::4, :3].mean(0) for k in range(4)])
    return parts.mean(0), parts.std(0, ddof=1) / 2


def fit_of_chiang(sigma_a, beta_n):
    """Equation 9, solved for the colour."""
    b = beta_n
    return np.exp(-np.sqrt(sigma_a) * (5.969 - 0.215 * b + 2.532 * b**2 - 10.73 * b**3 + 5.574 * b**4 + 0.245 * b**5))


def main():
    options = arguments()
    os.makedirs(options.out, exist_ok=True)
    files = [os.path.abspath(os.path.join(options.out, name)) for name in ("ball.npz", "sky.exr")]
    ball(files[0])
    sky(files[1])
    absorptions = [float(part) for part in options.absorption.split(",")]
    print("model,set,sigma_a,albedo,colour,error,chiang_2016")
    for first in range(0, len(absorptions), 3):
        sigma_a = (absorptions[first : first + 3] * 3)[:3]
        name = f"{options.model}_{options.set}_{sigma_a[0]}".replace("=", "_").replace(",", "_")
        colour, error = shown(options, files, sigma_a, os.path.join(options.out, name))
        for k, of_fibre in enumerate(albedos(options, sigma_a)):
            fit = fit_of_chiang(sigma_a[k], settings_of(options.set).get("beta_n", 0.3))
            print(f"{options.model},{options.set.replace(',', ' ')},{sigma_a[k]:g},{of_fibre:.5f},{colour[k]:.4f},{error[k]:.4f},"
                  f"{fit:.4f}", flush=True)


if __name__ == "__main__":
    main()
