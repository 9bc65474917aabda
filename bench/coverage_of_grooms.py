"""Coverage by `tiles` against brute force: four grooms, as framed and from four times as far, still and in a frame of their motion.

  PYTHONPATH=build/release/python python bench/coverage_of_grooms.py [--pixels 96] [--strands 600] [--samples 40]

Mean error of coverage over the pixels that hair covers, for each number of rows of samples, and of luminance over its mean for the default.
"""
import argparse
import copy
import json
import pathlib

import numpy

import cuticle

SCENES = pathlib.Path(__file__).resolve().parents[1] / "scenes"
ROWS = (0, 2, 4, 8, 16)
MOVING_FRAME = 6


def loaded(name):
    """A scene's hair alone."""
    scene = json.loads((SCENES / name).read_text())
    scene["head"] = {"present": False}
    scene.get("passes", {}).pop("resolve", None)
    return scene


def framed(scene, options, distance, moves):
    scene = copy.deepcopy(scene)
    camera = scene["camera"]
    target = numpy.array(camera["target_m"])
    camera["position_m"] = [float(x) for x in target + distance * (numpy.array(camera["position_m"]) - target)]
    camera["far_m"] = distance * camera.get("far_m", 10)
    camera["resolution_px"] = [options.pixels] * 2
    scene["strand_count"] = options.strands
    if not moves:
        for part in ("motion", "simulation", "colliders"):
            scene.pop(part, None)
    return scene


def picture(scene, folder, method, frame, **parameters):
    scene = copy.deepcopy(scene)
    scene.setdefault("passes", {})[method] = parameters
    renderer = cuticle.Renderer(scene, method, folder=str(folder))
    for k in range(frame):
        renderer.frame(k)
    return renderer.frame(frame)


def errors(drawn, truth):
    seen = (drawn[..., 3] > 0) | (truth[..., 3] > 0)
    light = [image[..., :3] @ numpy.array([0.2126, 0.7152, 0.0722]) for image in (drawn, truth)]
    return abs(drawn - truth)[..., 3][seen].mean(), abs(light[0] - light[1])[seen].mean() / light[1][seen].mean()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name, usual in (("--pixels", 96), ("--strands", 600), ("--samples", 40)):
        parser.add_argument(name, type=int, default=usual)
    options = parser.parse_args()
    print("groom, view".ljust(28), "".join(f"{rows:>3} rows" for rows in ROWS), "  luminance, 8 rows")
    for name in ("still.json", "ladder/blond.json", "ladder/curls.json", "ladder/fur.json"):
        base = loaded(name)
        for moves in (False, True) if "simulation" in base else (False,):
            for distance in (1, 4):
                scene, folder, frame = framed(base, options, distance, moves), (SCENES / name).parent, MOVING_FRAME if moves else 0
                truth = picture(scene, folder, "truth", frame, samples=min(64, options.samples if distance == 1 else 2 * options.samples))
                found = {rows: errors(picture(scene, folder, "tiles", frame, coverage_rows=rows), truth) for rows in ROWS}
                view = f"{pathlib.Path(name).stem}, {'moving' if moves else 'still'}, {'near' if distance == 1 else 'far'}"
                print(view.ljust(28), "".join(f"{found[rows][0]:8.4f}" for rows in ROWS), f"{found[8][1]:10.3f}", flush=True)


if __name__ == "__main__":
    main()
