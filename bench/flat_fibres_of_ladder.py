"""Direct light of the ladder's blond hair by the formulas of `marschner` over that by its tables, for round and flat fibres: each strand has a turn
of its own by the seeds given, without and with a twist, and tables hold the mean over turns.

  PYTHONPATH=build/release/python python bench/flat_fibres_of_ladder.py
"""
import json

from dual_scattering_of_ladder import LADDER, blond, light

# The scene's own, and one with both lights behind the camera, where flat fibres differ most from turn to turn.
VIEWS = {"the scene's camera and lights": None, "lights behind the camera": ([1, 0.3, 0.1], [1, 0.2, -0.2])}


def scene_of(aspect, to_lights):
    scene, own = blond(), json.loads((LADDER / "blond.json").read_text())
    scene["material"]["model"]["marschner"]["aspect"] = aspect
    scene["lights"] = own["lights"]
    scene["camera"] = dict(own["camera"], resolution_px=[96, 96])
    if to_lights:
        scene["camera"].update(position_m=[1.05, 0.1, 0], target_m=[0, 0.075, 0], fov_deg=19)
        for lamp, towards in zip(scene["lights"], to_lights):
            lamp["to_light"] = towards
    return scene


def direct(scene, **parameters):
    return light(scene, "reference", {"reference": {"bounces": 1, **parameters}}, samples=32)


def main():
    for view, to_lights in VIEWS.items():
        for aspect in (1, 0.95, 0.85):
            scene = scene_of(aspect, to_lights)
            tables = direct(scene, tables=True)
            for twist in (0,) if aspect == 1 else (0, 50):
                for seed in (0,) if aspect == 1 else (0, 1, 2):
                    ratio = direct(scene, twist=float(twist), turn_seed=seed) / tables
                    print(f"{view}, aspect {aspect}, twist {twist}, turn_seed {seed}: {ratio.round(3)}", flush=True)


if __name__ == "__main__":
    main()
