"""The files that the programs open, made by `cuticle`, and what stands in them by readers of our own (numpy alone)."""
import csv
import io
import json
import math
import pathlib
import random
import struct
import subprocess
import sys

import numpy

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/cli"))
from program import rows, run  # noqa: E402

MATERIAL = ["--model", "marschner", "--preset", "blond"]
PAIRS = 500
TARGETS = ("three", "babylon", "playcanvas")


def must(*arguments):
    done = run(*arguments)
    if done.returncode:
        raise RuntimeError(f"cuticle {' '.join(map(str, arguments))}: {done.stderr}")
    return done.stdout


def version():
    return must("--version").strip()


def random_direction(numbers):
    z, turn = numbers.uniform(-1, 1), numbers.uniform(0, 2 * math.pi)
    return [math.sqrt(1 - z * z) * math.cos(turn), math.sqrt(1 - z * z) * math.sin(turn), z]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def angles(pair):
    sin_i, sin_o = dot(pair["light"], pair["tangent"]), dot(pair["eye"], pair["tangent"])
    cosine = (dot(pair["light"], pair["eye"]) - sin_i * sin_o) / math.sqrt((1 - sin_i**2) * (1 - sin_o**2))
    return [math.degrees(angle) for angle in (math.asin(sin_i), math.asin(sin_o), math.acos(max(-1.0, min(1.0, cosine))))]


def make(folder, strands):
    """Grows the groom and writes it in every form; `folder` exists."""
    must("grow", "--share", strands, "--out", folder / "groom.npz", ROOT / "scenes/looks/straight.json")
    for name in ("groom.usda", "groom.abc", "strands.glb"):
        must("convert", folder / "groom.npz", folder / name)
    must("cards", folder / "groom.npz", "--out", folder / "cards")
    for name in ("cards.glb", "cards.obj", "cards.mtl", "base.png", "alpha.png"):
        (folder / name).write_bytes((folder / "cards" / name).read_bytes())
    must("bake", *MATERIAL, "--size", 128, "--format", "ktx2", "--target", ",".join(TARGETS), "--out", folder / "lut")
    must("models", "--export", "chiang", "--set", "sigma_a=0.1257/0.2/0.3", "--out", folder / "hair.mtlx")
    numbers = random.Random(5)
    pairs = [{name: random_direction(numbers) for name in ("tangent", "light", "eye")} for _ in range(PAIRS)]
    (folder / "pairs.json").write_text(json.dumps({"pairs": pairs}))


def exact(folder):
    """S of the pairs by the program in double."""
    text = io.StringIO()
    lines = csv.writer(text)
    lines.writerow(["theta_i", "theta_o", "phi"])
    lines.writerows(angles(pair) for pair in json.loads((folder / "pairs.json").read_text())["pairs"])
    (folder / "points.csv").write_text(text.getvalue())
    found = rows("eval", *MATERIAL, "--quantity", "S", "--points", folder / "points.csv")
    return numpy.array([[float(row[c]) for c in "rgb"] for row in found])


def groom(folder):
    """Positions, offsets and radii as the program wrote them."""
    with numpy.load(folder / "groom.npz") as file:
        names = {name.split("/")[-1]: name for name in file.files}
        return {name: file[names[name]] for name in names}


def glb(path):
    """The JSON of a .glb and its accessors as arrays."""
    data = path.read_bytes()
    size, = struct.unpack_from("<I", data, 12)
    text, binary = json.loads(data[20:20 + size]), data[28 + size:]
    parts = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}

    def array(accessor):
        view = text["bufferViews"][accessor["bufferView"]]
        kind = {5126: "<f4", 5125: "<u4"}[accessor["componentType"]]
        return numpy.frombuffer(binary, kind, accessor["count"] * parts[accessor["type"]], view["byteOffset"]).reshape(accessor["count"], -1)

    primitive = text["meshes"][0]["primitives"][0]
    found = {name: array(text["accessors"][k]) for name, k in primitive["attributes"].items()}
    found["indices"] = array(text["accessors"][primitive["indices"]])
    return found


def node(*arguments, timeout=300):
    return subprocess.run(["node", *map(str, arguments)], capture_output=True, text=True, timeout=timeout)
