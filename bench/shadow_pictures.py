"""The share of a light that self-shadowing leaves in a picture, by the maps of the real-time ways and by the path tracer.

  pip install numpy OpenEXR        (in a virtual environment of its own)
  CUTICLE=build/release/bin/cuticle CUTICLE_TEST_DATA=.. python bench/shadow_pictures.py OUT [--methods deep_opacity,opacity_map] [--resolutions 512,2048] [--settings '{"depth_offset_mm": -0.9}']

For three grooms of the test data: the sum of a picture of direct light over that of the same picture without self-shadowing, drawn by brute
force with transmittance from maps (filter of one texel), and by paths of one scattering, whose rays to the light meet opaque fibres. Both shade
by the formulas of the far field.
"""
import argparse
import json
import os
import subprocess
import sys

import numpy as np
import OpenEXR

GROOMS = {
    "side": {"file": "strands/tressfx/ponytail/side.tfx", "radius_m": 0.0005},
    "testhair1": {"file": "strands/tressfx/testhair1/TestHair1.tfx", "radius_m": 0.0007},
    "sintel": {"file": "strands/sintel/GEO-sintel_hair_emit.002-sintel_hair.tfx", "radius_m": 0.0007},
}
LAYERS = {"deep_opacity": {"layers": 16}, "opacity_map": {"slices": 32}}


def run(*words):
    done = subprocess.run([os.environ.get("CUTICLE", "build/release/bin/cuticle"), *map(str, words)], capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"{' '.join(map(str, words))}\n{done.stderr}")
    return done.stdout


def light(scene, method, folder):
    """Summed radiance of a picture."""
    path = os.path.join(folder, "scene.json")
    with open(path, "w") as file:
        json.dump(scene, file)
    run("render", path, "--method", method, "--out", folder)
    with OpenEXR.File(os.path.join(folder, "frame_0000.exr")) as file:
        channels = file.channels()
        pixels = channels["RGBA"].pixels[..., :3] if "RGBA" in channels else np.stack([channels[name].pixels for name in "RGB"], -1)
    return pixels.astype(float).sum()


def scene_of(groom, shadow, box, samples):
    lower, upper = np.array(box["lower"]), np.array(box["upper"])
    middle, size = (lower + upper) / 2, np.linalg.norm(upper - lower)
    return {
        "schema_version": 1, "groom": groom, "head": {"present": False}, "outputs": {"color": True},
        "material": {"model": {"marschner": {}}, "evaluate": "direct"}, "lights": [{"to_light": [0.6, 0.9, 0.8], "irradiance": [10, 10, 10]}],
        "shadow": {"method": shadow, "fibre_alpha": 1},
        "camera": {"position_m": list(middle + [0, 0, 2.2 * size]), "target_m": list(middle), "fov_deg": 26, "resolution_px": [256, 256]},
        "passes": {"resolve": {"background": [0, 0, 0]}, "lines": {"ambient": 0, "tip_variation": 0, "variation": 0},
                   "reference": {"bounces": 1, "samples": samples, "field": "far"}}}


def placed(groom):
    """With the file's units, and the box of its strands."""
    info = json.loads(run("info", groom["file"], "--json"))
    return groom | {"metres_per_unit": info["metres_per_unit"]}, info["bounds_m"]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("out")
    parser.add_argument("--grooms", default=",".join(GROOMS))
    parser.add_argument("--methods", default="deep_opacity,opacity_map,exact_list,deep_shadow,moments,fourier")
    parser.add_argument("--resolutions", default="512,2048")
    parser.add_argument("--samples", type=int, default=64)
    parser.add_argument("--settings", type=json.loads, default={}, help="JSON object: further settings of every method")
    options = parser.parse_args()
    os.makedirs(options.out, exist_ok=True)
    worst = 0
    for name in options.grooms.split(","):
        groom = dict(GROOMS[name])
        groom["file"] = os.path.join(os.environ["CUTICLE_TEST_DATA"], groom["file"])
        groom, box = placed(groom)
        share = lambda shadow, method: light(scene_of(groom, shadow, box, options.samples), method, options.out)
        open_light = share({"none": {}}, "supersampled")
        reference = share({"none": {}}, "reference") / open_light
        print(f"{name}: paths leave {reference:.4f}", flush=True)
        for method in options.methods.split(","):
            for resolution in options.resolutions.split(","):
                settings = {"resolution": int(resolution), "filter_texels": 1} | LAYERS.get(method, {}) | options.settings
                left = share({method: settings}, "supersampled") / open_light
                worst = max(worst, abs(left - reference))
                print(f"{name}: {method} {resolution}: {left:.4f}, {left - reference:+.4f}", flush=True)
    print(f"largest difference: {worst:.4f}")


if __name__ == "__main__":
    main()
