"""The scenes that pictures are measured on: hair alone, one distant light, a black background.

Grooms: three of the test data (CUTICLE_TEST_DATA) and a dense head of hair that `cuticle grow` makes.
"""
import json
import os
import subprocess

LADDER = os.path.abspath(os.path.join(os.path.dirname(__file__), "../scenes/ladder/blond_strands.json"))
LADDER_FIBRES, LADDER_STRANDS = 40000, 3144
PROGRAM = os.environ.get("CUTICLE", "build/release/bin/cuticle")
TO_LIGHT = (0.6, 0.9, 0.8)
# Absorption of a fibre per radius.
COLOURS = {"black": (3.352, 5.576, 10.96), "brown": (0.5447, 0.9061, 1.781), "blond": (0.06, 0.1, 0.2)}
GROOMS = {
    "ponytail": {
        "groom": {"file": "strands/tressfx/ponytail/ponytail.tfxproj", "metres_per_unit": 0.01, "radius_m": 3e-4},
        "camera": {"position_m": [1.1, 1.25, 2.3], "target_m": [0.0, 0.95, -0.05], "fov_deg": 27},
    },
    "testhair": {
        "groom": {"file": "strands/tressfx/testhair1/TestHair1.tfx", "metres_per_unit": 0.01, "radius_m": 1e-3},
        "camera": {},
    },
    "sintel": {
        "groom": {
            "file": "strands/sintel/GEO-sintel_hair_emit.002-sintel_hair.tfx", "metres_per_unit": 0.01,
            "radius_m": 2e-4, "interpolate": True,
        },
        "camera": {},
        "strands": {"strand_count": 2228, "strand_vertices": 32, "fibre_count": 2228},
    },
    "dense": {
        "grow": "density=4e5", "groom": {"radius_m": 8e-5},
        "camera": {"position_m": [0.42, 0.2, 1.0], "target_m": [0, 0.06, 0], "fov_deg": 27},
    },
}


def grown(strands, radius, folder, settings=""):
    """A file of grown hair; made once for a folder."""
    path = os.path.join(folder, "grown_" + f"{strands},radius={radius:g}{settings}".replace("=", "_").replace(",", "_") + ".npz")
    if not os.path.exists(path):
        growing = f"radius={radius}" + ("," + settings if settings else "")
        subprocess.run([PROGRAM, "grow", "--strands", strands, "--set", growing, "--out", path], check=True,
                       capture_output=True)
    return path


def with_strands(specification, times):
    """A file's hair with so many times as many strands in as many locks."""
    with open(specification) as file:
        hair = json.load(file)
    hair["strands"]["density"] *= times
    clumping = hair.get("shaping", {}).get("clumping", {})
    if "strands_per_lock" in clumping:
        clumping["strands_per_lock"] = round(clumping["strands_per_lock"] * times)
    return hair


def ladder_of_fibres(folder):
    """The ladder's blond hair with as many strands as the fibres for which its own stand."""
    path = os.path.join(folder, "ladder_of_fibres.json")
    if not os.path.exists(path):
        with open(path, "w") as file:
            json.dump(with_strands(LADDER, LADDER_FIBRES / LADDER_STRANDS), file)
    return os.path.abspath(path)


def groom_of(name, folder):
    known = GROOMS[name]
    if "grow" in known:
        return {"file": os.path.abspath(grown(known["grow"], known["groom"]["radius_m"], folder)), "metres_per_unit": 1,
                **known["groom"]}
    return {**known["groom"], "file": os.path.join(os.environ["CUTICLE_TEST_DATA"], known["groom"]["file"])}


def scene(name, folder, sigma_a=COLOURS["blond"], size=240, to_light=TO_LIGHT, groom=None, camera=None):
    """The scene as a dictionary; grown hair is written to the folder."""
    return {
        "schema_version": 1,
        "name": name,
        "groom": {"taper": 0, **(groom or groom_of(name, folder))},
        "head": {"present": False},
        "material": {"model": {"chiang": {"eta": 1.55, "beta_m": 0.3, "beta_n": 0.3, "alpha": 0, "sigma_a": list(sigma_a),
                                         "tolerance": 1e-3}},
                     "evaluate": "direct"},
        "lights": [{"name": "key", "to_light": list(to_light), "irradiance": [10, 10, 10]}],
        "shadow": {"method": {"deep_shadow": {"resolution": 1024, "filter_texels": 1}}, "fibre_alpha": 1},
        "camera": {**(camera or GROOMS[name]["camera"]), "resolution_px": [size, size]},
        **GROOMS[name].get("strands", {}),
        "passes": {"resolve": {"background": [0, 0, 0]}, "lines": {"ambient": 0}},
    }


def block_means(picture, side=8):
    """Of red, green and blue over squares of `side` pixels; what is left over at the edges is not counted."""
    height, width = (n // side * side for n in picture.shape[:2])
    blocks = picture[:height, :width, :3].reshape(height // side, side, width // side, side, 3)
    return blocks.mean((1, 3))


def write(scene, path):
    with open(path, "w") as file:
        json.dump(scene, file, indent=1)
    return path
