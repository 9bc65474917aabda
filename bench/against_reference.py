"""A scene's picture by the real-time ways of drawing strands, against the path tracer.

  pip install numpy OpenEXR        (in a virtual environment of its own)
  CUTICLE=build/release/bin/cuticle python bench/against_reference.py SCENE.json OUT [--methods tiles,quads,lines] [--samples 64]

Prints, for each way: its coverage, its light (mean radiance of red, green, blue) and the root mean square of the differences of means over
8 x 8 pixels (where the reference has light), each as a share of the reference's. Direct light is compared with paths of one scattering; with
dual scattering (`passes.dual_scattering`), light with paths of any length. The scene must have a black background.
"""
import argparse
import json
import os
import subprocess
import sys

import numpy as np
import OpenEXR


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("scene")
    parser.add_argument("out")
    parser.add_argument("--methods", default="tiles,quads,lines,truth")
    parser.add_argument("--samples", type=int, default=64)
    return parser.parse_args()


def render(scene, out, *options):
    program = os.environ.get("CUTICLE", "build/release/bin/cuticle")
    done = subprocess.run([program, "render", scene, "--out", out, *options], capture_output=True, text=True)
    if done.returncode:
        sys.exit(done.stderr)
    for line in done.stderr.splitlines():
        if line.startswith("reference:"):
            print(line)
    with OpenEXR.File(os.path.join(out, "frame_0000.exr")) as file:
        channels = file.channels()
        if "RGBA" in channels:
            return channels["RGBA"].pixels.astype(float)
        return np.stack([channels[name].pixels for name in "RGBA"], -1).astype(float)


def block_means(picture, side=8):
    height, width = (n // side * side for n in picture.shape[:2])
    blocks = picture[:height, :width, :3].reshape(height // side, side, width // side, side, 3)
    return blocks.mean((1, 3))


def show(name, picture, reference):
    mine, wanted = block_means(picture), block_means(reference)
    lit = wanted.sum(-1) > 0.05 * wanted.sum(-1).max()
    rms = np.sqrt(((mine - wanted)[lit] ** 2).mean() / (wanted[lit] ** 2).mean())
    light = picture[..., :3].mean((0, 1)) / reference[..., :3].mean((0, 1))
    coverage = picture[..., 3].mean() / reference[..., 3].mean()
    print(f"{name:24} coverage {coverage:.3f}  light {light[0]:.3f} {light[1]:.3f} {light[2]:.3f}  rms {rms:.3f}")


def with_dual_scattering(path, out):
    with open(path) as file:
        scene = json.load(file)
    scene.setdefault("passes", {})["dual_scattering"] = {}
    changed = os.path.join(os.path.dirname(os.path.abspath(path)), os.path.basename(out) + "_dual.json")
    with open(changed, "w") as file:
        json.dump(scene, file)
    return changed


def main():
    options = arguments()
    samples = ["--method", "reference", "--samples", str(options.samples)]
    direct = render(options.scene, options.out + "/reference_direct", *samples, "--bounces", "1")
    full = render(options.scene, options.out + "/reference_full", *samples)
    dual = with_dual_scattering(options.scene, options.out)
    for method in options.methods.split(","):
        show(method + ", direct", render(options.scene, f"{options.out}/{method}", "--method", method), direct)
    for method in options.methods.split(","):
        picture = render(dual, f"{options.out}/{method}_dual", "--method", method)
        show(method + ", dual scattering", picture, full)
    os.remove(dual)


if __name__ == "__main__":
    main()
