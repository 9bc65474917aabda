"""Pictures by the real-time ways of drawing strands, against the path tracer.

  pip install -r bench/requirements.txt        (in a virtual environment of its own)
  export CUTICLE=build/release/bin/cuticle CUTICLE_TEST_DATA=...
  python bench/against_reference.py OUT [--grooms ponytail,dense] [--methods tiles,lines] [--colours blond,black] [--samples 64]
  python bench/against_reference.py OUT --scene SCENE.json      (a scene of your own, on a black background)

Prints, for each way of drawing: its coverage, its light (mean radiance of red, green, blue) and the root mean square of the differences of
means over 8 x 8 pixels (where the reference has light), each as a share of the reference's. Direct light is compared with paths of one
scattering; with dual scattering (`passes.dual_scattering`), light with paths of any length, for each colour. The method `rays` is the path tracer
with dual scattering in the place of longer paths (`--match dual_scattering`). With --shares it says what share of the direct light without shadows is
left, each over the same way's picture without (`shadow.method` `none`; `--match shadow=none`). Pictures that OUT has are kept.
"""
import argparse
import json
import os
import subprocess
import sys

import numpy as np
import OpenEXR

import measured_scenes


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("out")
    parser.add_argument("--scene")
    parser.add_argument("--grooms", default=",".join(measured_scenes.GROOMS))
    parser.add_argument("--methods", default="supersampled,tiles,quads,lines")
    parser.add_argument("--colours", default="black,brown,blond")
    parser.add_argument("--samples", type=int, default=64)
    parser.add_argument("--size", type=int, default=240)
    parser.add_argument("--evaluate", choices=("direct", "tables"), default="direct", help="of the real-time ways")
    parser.add_argument("--shadow", type=json.loads, action="append", help="method with its parameters, JSON; may be given again")
    parser.add_argument("--to-light", default="0.6,0.9,0.8")
    parser.add_argument("--segment-parts", type=int, help="of segments, in the real-time ways (default: chosen by the program)")
    parser.add_argument("--whole-segments", action="store_true", help="of 'tiles': segments with parts are drawn as one")
    parser.add_argument("--densities", help="d_f,d_b of dual scattering")
    parser.add_argument("--only", choices=("direct", "dual"))
    parser.add_argument("--shares", action="store_true", help="of direct light: the share that shadows leave, in red")
    return parser.parse_args()


def pixels(folder, frame=0):
    with OpenEXR.File(os.path.join(folder, f"frame_{frame:04}.exr")) as file:
        channels = file.channels()
        if "RGBA" in channels:
            return channels["RGBA"].pixels.astype(float)
        return np.stack([channels[name].pixels for name in "RGBA"], -1).astype(float)


def render(scene, out, *options, frame=0):
    if not os.path.exists(os.path.join(out, f"frame_{frame:04}.exr")):
        os.makedirs(out, exist_ok=True)
        path = measured_scenes.write(scene, os.path.join(out, "scene.json"))
        done = subprocess.run([measured_scenes.PROGRAM, "render", path, "--frames", f"{frame}:{frame}", "--out", out, *options], capture_output=True,
                              text=True)
        if done.returncode:
            sys.exit(f"{out}: {done.stderr}")
    return pixels(out, frame)


def show(name, picture, reference):
    mine, wanted = measured_scenes.block_means(picture), measured_scenes.block_means(reference)
    lit = wanted.sum(-1) > 0.05 * wanted.sum(-1).max()
    rms = np.sqrt(((mine - wanted)[lit] ** 2).mean() / (wanted[lit] ** 2).mean())
    light = picture[..., :3].mean((0, 1)) / reference[..., :3].mean((0, 1))
    coverage = picture[..., 3].mean() / reference[..., 3].mean()
    print(f"{name:34} coverage {coverage:.3f}  light {light[0]:.3f} {light[1]:.3f} {light[2]:.3f}  rms {rms:.3f}",
          flush=True)


def densities(options):
    if not options.densities:
        return {}
    forward, backward = map(float, options.densities.split(","))
    return {"forward_density": forward, "backward_density": backward}


def name_of(shadow):
    """Words for a method with its parameters."""
    if not shadow:
        return ""
    return "_".join([method + "".join(f"_{name}={value}" for name, value in settings.items())
                     for method, settings in shadow.items()])


def changed(scene, options, dual, shadow):
    """The scene for a real-time way."""
    scene = json.loads(json.dumps(scene))
    scene["material"]["evaluate"] = options.evaluate
    if options.segment_parts:
        scene["groom"]["segment_parts"] = options.segment_parts
    if options.whole_segments:
        scene.setdefault("passes", {})["tile_lists"] = {"whole_segments": True}
    if shadow:
        scene["shadow"]["method"] = shadow
    if dual:
        scene.setdefault("passes", {})["dual_scattering"] = densities(options)
    return scene


def drawn_by(method, options, dual):
    """Options of a way of drawing."""
    if method != "rays":
        return ["--method", method]
    restriction = "dual_scattering" if dual else "single_scattering"
    return ["--method", "reference", "--samples", str(options.samples), "--match", restriction]


def show_share(name, pictures, references):
    """Of pairs with and without shadows: the share of the light that is left, and that of the reference."""
    left, wanted = (with_shadows[..., 0].mean() / without[..., 0].mean() for with_shadows, without in (pictures, references))
    print(f"{name:34} light left {left:.4f}, reference {wanted:.4f}, difference {left - wanted:+.4f}", flush=True)


def traced(scene, out, options, *more):
    return render(scene, out, "--method", "reference", "--samples", str(options.samples), *more)


def compare(name, scene, out, options, dual):
    bounces = [] if dual else ["--bounces", "1"]
    kind = "all" if dual else "direct"
    reference = traced(scene, f"{out}/reference_{kind}", options, *bounces)
    shares = options.shares and not dual
    bare = traced(scene, f"{out}/reference_none", options, *bounces, "--match", "shadow=none") if shares else None
    for method in options.methods.split(","):
        for shadow in options.shadow or [None]:
            words = [method, kind, name_of(shadow), "whole" if options.whole_segments else "", options.densities if dual and options.densities else ""]
            way = "_".join(word for word in words if word)
            picture = render(changed(scene, options, dual, shadow), f"{out}/{way}", *drawn_by(method, options, dual))
            title = f"{name} {method} {kind} {name_of(shadow)}".rstrip()
            show(title, picture, reference)
            if shares:
                without = render(changed(scene, options, dual, {"none": {}}), f"{out}/{method}_none", *drawn_by(method, options, dual))
                show_share(title, (picture, without), (reference, bare))


def main():
    options = arguments()
    if options.scene:
        with open(options.scene) as file:
            cases = {"scene": json.load(file)}
    else:
        to_light = [float(part) for part in options.to_light.split(",")]
        os.makedirs(options.out, exist_ok=True)
        cases = {f"{groom} {colour}": measured_scenes.scene(groom, options.out, measured_scenes.COLOURS[colour], options.size,
                                                            to_light)
                 for groom in options.grooms.split(",") for colour in options.colours.split(",")}
    for name, scene in cases.items():
        for kind in ("direct", "dual"):
            if options.only in (None, kind):
                compare(name, scene, os.path.join(options.out, name.replace(" ", "_")), options, kind == "dual")


if __name__ == "__main__":
    main()
