"""One picture for compare.py by Mitsuba 3: python mitsuba_picture.py FOLDER PICTURE.npy BOUNCES SAMPLES SEED

The `hair` model needs `bsplinecurve` (`linearcurve` gives it no tangent). The scene is in millimetres: rays to a light begin a fixed distance off the
surface, which in metres is more than a fibre's radius.
"""
import json
import os
import sys

import mitsuba as mi
import numpy as np

MILLIMETRES = 1000


def write_curves(folder):
    path = os.path.join(folder, "curves.txt")
    if os.path.exists(path):
        return path
    with np.load(os.path.join(folder, "controls.npz")) as file:
        offsets, positions, radius = file["offsets"], MILLIMETRES * file["positions"], MILLIMETRES * float(file["radius"])
    with open(path, "w") as out:
        for first, end in zip(offsets[:-1], offsets[1:]):
            for k in [first, first, *range(first, end), end - 1, end - 1]:
                out.write("{:.7g} {:.7g} {:.7g} {:.7g}\n".format(*positions[k], radius))
            out.write("\n")
    return path


def hair(fibre, curves):
    return {
        "type": "bsplinecurve", "filename": curves,
        "bsdf": {"type": "hair", "int_ior": fibre["eta"], "ext_ior": 1.0, "scale": 1.0, "scale_tilt": 0.0,
                 "sigma_a": {"type": "rgb", "value": fibre["sigma_a"]}, "longitudinal_roughness": fibre["beta_m"],
                 "azimuthal_roughness": fibre["beta_n"]},
    }


def sensor(camera):
    eye, target = ([MILLIMETRES * x for x in camera[key]] for key in ("position_m", "target_m"))
    width, height = camera["resolution_px"]
    return {
        "type": "perspective", "fov": camera["fov_deg"], "fov_axis": "y", "near_clip": 10, "far_clip": 1e5,
        "to_world": mi.ScalarTransform4f().look_at(eye, target, [0, 1, 0]),
        "film": {"type": "hdrfilm", "width": width, "height": height, "rfilter": {"type": "box"}, "pixel_format": "rgba",
                 "component_format": "float32"},
        "sampler": {"type": "independent"},
    }


def described(folder, bounces):
    """The scene of compare.py for mi.load_dict."""
    with open(os.path.join(folder, "scene.json")) as file:
        scene = json.load(file)
    light = np.array(scene["lights"][0]["to_light"])
    return {
        "type": "scene", "integrator": {"type": "path", "max_depth": bounces + 1, "rr_depth": 20},
        "sensor": sensor(scene["camera"]),
        "light": {"type": "directional", "direction": (-light / np.linalg.norm(light)).tolist(),
                  "irradiance": {"type": "rgb", "value": scene["lights"][0]["irradiance"]}},
        "hair": hair(scene["material"]["model"]["chiang"], write_curves(folder)),
    }


def main():
    folder, picture, bounces, samples, seed = sys.argv[1], sys.argv[2], *map(int, sys.argv[3:6])
    mi.set_variant("scalar_rgb")
    made = mi.load_dict(described(folder, bounces))
    np.save(picture, np.array(mi.render(made, spp=samples, seed=seed)))


if __name__ == "__main__":
    main()
