"""Direct light that falls from behind on rows of strands, one and two: `tiles` over the reference, by model. The second row stands behind the gaps
of the first, so that light reaches the middle of the first row's fibres alone: what a mean over the width cannot tell.

  PYTHONPATH=build/release/python python bench/rows_against_light.py
"""
import numpy

import cuticle

SPACING, RADIUS, APART, HEIGHT = 1.2e-3, 5e-4, 2e-3, 0.05  # metres
MODELS = {"chiang": {"sigma_a": [0.06, 0.1, 0.2]}, "deon": {"sigma_a": [0.06, 0.1, 0.2]}, "marschner": {"sigma_a": [0.13, 0.21, 0.41]}}


def rows(count):
    places = [(SPACING * (i + row % 2 / 2 - 29.5), -APART * row) for row in range(count) for i in range(60)]
    strands = [[[x, y, z] for y in numpy.linspace(-HEIGHT, HEIGHT, 9)] for x, z in places]
    return cuticle.make_groom(numpy.array(strands, numpy.float32), radii=RADIUS)


def light(scene, way, passes, **settings):
    return cuticle.Renderer({**scene, "passes": passes}, way, **settings).frame(0)[..., :3].mean()


def main():
    for count in (1, 2):
        for model, values in MODELS.items():
            scene = {
                "groom": rows(count), "head": {"present": False}, "material": {"model": {model: values}},
                "lights": [{"to_light": [0.05, 0.3, -1], "irradiance": [5, 5, 5]}], "shadow": {"method": {"deep_shadow": {"resolution": 2048}}},
                "camera": {"position_m": [0, 0, 1], "target_m": [0, 0, 0], "fov_deg": 4, "resolution_px": [96, 96]},
            }
            truth = light(scene, "reference", {"reference": {"bounces": 1}}, samples=64)
            drawn = light(scene, "tiles", {"lines": {"ambient": 0}})
            print(f"{count} row{'s' if count > 1 else ''}, {model}: reference {truth:.3f}, tiles {drawn:.3f}, {drawn / truth:.2f} of it")


if __name__ == "__main__":
    main()
