"""What path tracing costs: HairMSNN's published setting, and the way to a relative MSE of 1 % on the ladder's scenes.

  export CUTICLE=build/release/bin/cuticle
  python bench/path_speed.py OUT [--only published,ladder] [--samples 2] [--ladder-samples 64] [--size 128]

published: Chiang, roughness .3 and .3, tilt 2 degrees, sigma_a .06, .1, .2, 1024 x 1024 pixels, 40 scatterings, 500 samples (KT et al., Accelerating
Hair Rendering by Learning High-Order Scattered Radiance, 2023), on straight and curly hair that `cuticle grow` makes. A few samples are drawn; the
time of 500 is theirs times the ratio.

ladder: the scenes of `cuticle study picture` at rest, a third of the samples and then all: the difference is what samples cost without start and
tree. The relative MSE of a picture is the mean variance of its pixels over the mean square of its light; it falls with 1 / samples, from which the
time to 1 % follows. Seconds are of the processor.
"""
import argparse
import json
import os
import resource
import subprocess
import sys

import numpy as np
import OpenEXR

import measured_scenes

SCENES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "scenes")
STRANDS_OF_A_LOOK = {"straight": 1e-4, "curly": 1.2e-4}  # their radii, metres


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("out")
    parser.add_argument("--only", default="published,ladder")
    parser.add_argument("--samples", type=int, default=2)
    parser.add_argument("--ladder-samples", type=int, default=64)
    parser.add_argument("--size", type=int, default=128)
    return parser.parse_args()


def seconds(command):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode:
        sys.exit(done.stderr)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def traced(scene, out, samples, *options):
    """Processor seconds of a picture, its channels."""
    os.makedirs(out, exist_ok=True)
    path = measured_scenes.write(scene, os.path.join(out, "scene.json"))
    spent = seconds([measured_scenes.PROGRAM, "render", path, "--out", out, "--method", "reference", "--samples", str(samples), "--aovs", *options])
    with OpenEXR.File(os.path.join(out, "frame_0000.exr"), separate_channels=True) as file:
        return spent, {name: channel.pixels.astype(float) for name, channel in file.channels().items()}


def relative_mse(channels):
    light, variance = (np.stack([channels[prefix + c] for c in "RGB"]) for prefix in ("", "variance."))
    return variance.mean() / (light**2).mean()


def twice(scene, out, few, many, *options):
    """Seconds of a sample, and the relative MSE of the picture of many."""
    first, _ = traced(scene, out, few, *options)
    second, channels = traced(scene, out, many, *options)
    return (second - first) / (many - few), relative_mse(channels), channels


def look(name, out):
    path = os.path.join(out, f"{name}.npz")
    if not os.path.exists(path):
        seconds([measured_scenes.PROGRAM, "grow", os.path.join(SCENES, "looks", f"{name}.json"), "--out", path])
    return {"file": os.path.abspath(path), "metres_per_unit": 1, "radius_m": STRANDS_OF_A_LOOK[name]}


def published(options):
    for name in STRANDS_OF_A_LOOK:
        scene = measured_scenes.scene("dense", options.out, size=1024, groom=look(name, options.out))
        scene["material"]["model"]["chiang"]["alpha"] = -0.0349
        each, _, channels = twice(scene, f"{options.out}/published_{name}", options.samples, 3 * options.samples, "--bounces", "40")
        print(f"{name}: {each:.1f} s a sample, {500 * each:.0f} s for 500; hair covers {channels['A'].mean():.2f}", flush=True)


def ladder(options):
    for name in ("blond", "curls", "fur"):
        with open(os.path.join(SCENES, "ladder", f"{name}.json")) as file:
            scene = json.load(file)
        for part in ("simulation", "motion", "colliders"):
            scene.pop(part, None)
        scene["groom"] = {"specification": os.path.abspath(os.path.join(SCENES, "ladder", scene["groom"]["specification"]))}
        scene["camera"]["resolution_px"] = [options.size, options.size]
        many = options.ladder_samples
        each, error, _ = twice(scene, f"{options.out}/ladder_{name}", many // 3, many)
        needed = many * error / 0.01
        print(f"{name}, {options.size} x {options.size}: relative MSE {error:.3g} with {many} samples, {each:.2f} s a sample; 1 % takes {needed:.0f} samples, "
              f"{needed * each:.0f} s", flush=True)


def main():
    options = arguments()
    os.makedirs(options.out, exist_ok=True)
    for part in options.only.split(","):
        {"published": published, "ladder": ladder}[part](options)


if __name__ == "__main__":
    main()
