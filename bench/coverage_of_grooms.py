"""Coverage by `tiles` against brute force: four grooms, as framed and from four times as far, still or (--moving) in a frame of their motion.

  PYTHONPATH=build/release/python python bench/coverage_of_grooms.py [--pixels 96] [--strands 600] [--samples 256] [--grooms still,ladder/blond,...] [--rows 0,2,4,8,16] [--moving]

Mean error of coverage over the pixels that hair covers, for each number of rows of samples, and of luminance over its mean for the most.
The truth has --samples along each side of a pixel: above 64 the mean over a picture of more pixels. The last column is the mean difference between
two truths, that one and one of 3/4 as many: what is left of the errors where they come near it is the truth's.
"""
import argparse
import copy
import json
import pathlib

import numpy

import cuticle

SCENES = pathlib.Path(__file__).resolve().parents[1] / "scenes"
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


def truth_of(scene, folder, frame, samples):
    """The mean over squares of the picture's pixels of one with `finer` times as many along each side."""
    finer = -(-samples // 64)
    pixels = scene["camera"]["resolution_px"]
    scene = copy.deepcopy(scene)
    scene["camera"]["resolution_px"] = [finer * count for count in pixels]
    fine = picture(scene, folder, "supersampled", frame, samples=samples // finer)
    return fine.reshape(pixels[1], finer, pixels[0], finer, 4).mean((1, 3))


def errors(drawn, truth):
    seen = (drawn[..., 3] > 0) | (truth[..., 3] > 0)
    light = [image[..., :3] @ numpy.array([0.2126, 0.7152, 0.0722]) for image in (drawn, truth)]
    return abs(drawn - truth)[..., 3][seen].mean(), abs(light[0] - light[1])[seen].mean() / light[1][seen].mean()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name, usual in (("--pixels", 96), ("--strands", 600), ("--samples", 256)):
        parser.add_argument(name, type=int, default=usual)
    parser.add_argument("--grooms", default="still,ladder/blond,ladder/curls,ladder/fur")
    parser.add_argument("--rows", default="0,2,4,8,16")
    parser.add_argument("--moving", action="store_true")
    options = parser.parse_args()
    rows = [int(text) for text in options.rows.split(",")]
    print("groom, view".ljust(28), "".join(f"{count:>3} rows" for count in rows), "  luminance, most rows", "  between truths")
    for name in options.grooms.split(","):
        base, folder, frame = loaded(name + ".json"), (SCENES / name).parent, MOVING_FRAME if options.moving else 0
        for distance in (1, 4):
            scene = framed(base, options, distance, options.moving)
            truth, other = (truth_of(scene, folder, frame, samples) for samples in (options.samples, 3 * options.samples // 4))
            found = [errors(picture(scene, folder, "tiles", frame, coverage_rows=count), truth) for count in rows]
            view = f"{pathlib.Path(name).name}, {'moving' if options.moving else 'still'}, {'near' if distance == 1 else 'far'}"
            print(view.ljust(28), "".join(f"{of[0]:8.4f}" for of in found), f"{found[-1][1]:10.3f}{errors(other, truth)[0]:18.4f}", flush=True)


if __name__ == "__main__":
    main()
