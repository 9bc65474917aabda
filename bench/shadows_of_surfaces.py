"""What shadows between hair and surfaces change in the toolkit's scenes, beside the path tracer: light of frame 0 (red, green, blue, by `tiles`
with dual scattering) over all light of paths, and the root mean square of the differences of means over 8 x 8 pixels, as a share of paths'.

  PYTHONPATH=build/release/python CUTICLE_TEST_DATA=.. python bench/shadows_of_surfaces.py [SCENE.json ...] [--samples 128]

Surfaces are black, so that all light is the hair's, and cover hair behind them.
"""
import argparse
import pathlib

import numpy

import cuticle
from measured_scenes import block_means

SCENES = pathlib.Path(__file__).resolve().parent.parent / "scenes"
BLACK = [0, 0, 0]


def light(path, way, **passes):
    black = {"head": {"skin": BLACK, "scalp": BLACK, "ambient": 0}, "fins": {"root": BLACK, "tip": BLACK},
             "lines": {"ambient": 0, "variation": 0, "tip_variation": 0}, "resolve": {"background": BLACK}, "dual_scattering": {}}
    scene = {"$include": str(path.resolve()), "camera": {"resolution_px": [240, 240]}, "passes": {**black, **passes}}
    return cuticle.render(scene, method=way)[..., :3]


def compared(picture, paths):
    apart = block_means(picture) - block_means(paths)
    shares = picture.mean((0, 1)) / paths.mean((0, 1))
    return "{:6.2f} {:.2f} {:.2f}".format(*shares) + f"{numpy.sqrt((apart ** 2).mean() / (block_means(paths) ** 2).mean()):6.2f}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("scenes", nargs="*", type=pathlib.Path)
    parser.add_argument("--samples", type=int, default=128)
    options = parser.parse_args()
    print(f"{'scene':16}{'as scenes are':>22}{'without':>20}")
    for path in options.scenes or [SCENES / f"{name}.json" for name in ("fox_running", "mermaid", "nalu", "head_turn", "loose_hair", "clumped")]:
        paths = light(path, "reference", reference={"samples": options.samples})
        found = [compared(light(path, "tiles", **passes), paths) for passes in ({}, {"surface_shadow": {"wanted": False}})]
        print(f"{path.stem:16}", "   ".join(found), flush=True)


if __name__ == "__main__":
    main()
