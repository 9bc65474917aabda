"""Light of the ladder's blond hair, at rest, from the front and without a head, over that of the reference: direct light, and dual scattering with its
corrections and without them, by two shadow methods.

  PYTHONPATH=build/release/python python bench/dual_scattering_of_ladder.py
"""
import copy
import json
import pathlib

import cuticle

LADDER = pathlib.Path(__file__).resolve().parent.parent / "scenes/ladder"
SHADOWS = {"deep_opacity": {"layers": 8, "resolution": 512, "filter_texels": 1}, "deep_shadow": {"resolution": 1024}}


def blond():
    scene = json.loads((LADDER / "blond.json").read_text())
    for moving in ("simulation", "motion", "colliders"):
        scene.pop(moving)
    scene["passes"].pop("dual_scattering")
    scene["head"] = {"present": False}
    scene["material"]["model"] = {"marschner": {"sigma_a": [0.1257, 0.2091, 0.411]}}
    scene["camera"].update(position_m=[0.45, 0.1, 1], target_m=[0, 0.075, 0], fov_deg=19, resolution_px=[96, 96])
    for light, towards in zip(scene["lights"], ([0.6, 0.7, 0.6], [-0.6, 0.5, -0.7])):
        light["to_light"] = towards
    return scene


def light(scene, way, passes, **settings):
    scene = copy.deepcopy(scene)
    scene["passes"].update(passes)
    return cuticle.Renderer(scene, way, folder=str(LADDER), **settings).frame(0)[..., :3].reshape(-1, 3).mean(axis=0)


def main():
    scene = blond()
    truth = light(scene, "reference", {}, samples=256)
    print("reference, direct light", light(scene, "reference", {"reference": {"bounces": 1}}, samples=64) / truth)
    for method, values in SHADOWS.items():
        scene["shadow"] = {"method": {method: values}}
        print(f"{method}: tiles, direct light", light(scene, "tiles", {}) / truth)
        for corrections in ("path_tracing", "none"):
            print(f"{method}: dual scattering, corrections {corrections}", light(scene, "tiles", {"dual_scattering": {"corrections": corrections}}) / truth)


if __name__ == "__main__":
    main()
