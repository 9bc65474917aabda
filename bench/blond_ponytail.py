"""A blond ponytail by path tracing, dual scattering, single scattering and cards: pictures, errors and times.

  pip install -r bench/requirements.txt
  export CUTICLE=build/release/bin/cuticle CUTICLE_TEST_DATA=...
  python bench/blond_ponytail.py OUT [--samples 1024] [--size 320]

Writes OUT/ways.png: the four pictures, all exposed alike, above what each lacks (blue) or has too much (red) beside path tracing. There the light of
pixels that outshine their surroundings is spread over these (the noise of path tracing). Prints for each its coverage, light and error
(against_reference.py, of what was drawn) and the seconds of the processor.
"""
import argparse
import json
import os
import resource

import numpy as np
from PIL import Image, ImageDraw

import against_reference
import measured_scenes

WAYS = {
    "path tracing": ("reference", {}),
    "dual scattering": ("tiles", {"dual_scattering": {}}),
    "single scattering": ("tiles", {}),
    "cards": ("cards", {"dual_scattering": {}}),
}


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("out")
    parser.add_argument("--samples", type=int, default=1024)
    parser.add_argument("--size", type=int, default=320)
    return parser.parse_args()


def lit_scene(options):
    """The ponytail under a key light before it, a weaker one beside and one behind."""
    scene = measured_scenes.scene("ponytail", options.out, size=options.size)
    scene["lights"] = [
        {"name": "key", "to_light": [0.6, 0.5, 0.8], "irradiance": [3, 2.9, 2.7]},
        {"name": "fill", "to_light": [-0.8, 0.3, 0.5], "irradiance": [1, 1.1, 1.2]},
        {"name": "rim", "to_light": [-0.5, 0.5, -0.8], "irradiance": [2, 2, 2.1]},
    ]
    return scene


def processor_seconds():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def draw(scene, way, options):
    method, passes = WAYS[way]
    scene = json.loads(json.dumps(scene))
    scene["passes"].update(passes)
    if method == "cards":
        scene["material"] = {"model": {"marschner": {"beta": 0.25, "alpha": 0, "sigma_a": list(measured_scenes.COLOURS["blond"])}}}
    more = ["--samples", str(options.samples)] if method == "reference" else []
    before = processor_seconds()
    picture = against_reference.render(scene, os.path.join(options.out, way.replace(" ", "_")), "--method", method, *more)
    return picture, processor_seconds() - before


def spread(picture, side=2, bright=2.5, rounds=3):
    """Light of a pixel beyond `bright` times the median of (2 side + 1)^2, shared out among these."""
    picture = picture[..., :3].copy()
    height, width = picture.shape[:2]
    for _ in range(rounds):
        beside = np.pad(picture, ((side, side), (side, side), (0, 0)), "reflect")
        around = np.lib.stride_tricks.sliding_window_view(beside, (2 * side + 1, 2 * side + 1), (0, 1))
        beyond = np.maximum(picture - bright * np.median(around, (3, 4)), 0)
        shared = np.pad(beyond / (2 * side + 1) ** 2, ((side, side), (side, side), (0, 0)))
        picture -= beyond
        for y in range(2 * side + 1):
            for x in range(2 * side + 1):
                picture += shared[y : y + height, x : x + width]
    return picture


def as_bytes(linear):
    return (255 * np.clip(linear, 0, 1) ** (1 / 2.2) + 0.5).astype(np.uint8)


def error_picture(picture, reference, scale):
    off = measured_scenes.block_means(picture - reference, 4).mean(-1) * scale
    off = np.repeat(np.repeat(off, 4, 0), 4, 1)
    colours = np.stack([1 + np.minimum(off, 0), 1 - np.abs(off), 1 - np.maximum(off, 0)], -1)
    return (255 * np.clip(colours, 0, 1)).astype(np.uint8)


def main():
    options = arguments()
    os.makedirs(options.out, exist_ok=True)
    scene = lit_scene(options)
    drawn = {way: draw(scene, way, options) for way in WAYS}
    reference = drawn["path tracing"][0]
    hair = measured_scenes.block_means(reference[..., [3, 3, 3]]).min(-1) > 0.9
    scale = 0.6 / np.percentile(measured_scenes.block_means(reference)[hair], 90)
    for way, (picture, seconds) in drawn.items():
        against_reference.show(f"{way}, {seconds:.0f} s", picture, reference)
    shown = {way: spread(picture) if way == "path tracing" else picture for way, (picture, _) in drawn.items()}
    rows = [[as_bytes(scale * picture[..., :3]) for picture in shown.values()],
            [error_picture(picture[..., :3], shown["path tracing"], scale) for picture in shown.values()]]
    image = Image.fromarray(np.concatenate([np.concatenate(row, 1) for row in rows]))
    for k, way in enumerate(WAYS):
        ImageDraw.Draw(image).text((8 + k * options.size, 6), way, fill=(255, 255, 255))
    image.save(os.path.join(options.out, "ways.png"))


if __name__ == "__main__":
    main()
