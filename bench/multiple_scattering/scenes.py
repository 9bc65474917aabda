"""Scenes from which the corrections of dual scattering are fitted, and the files that fit.cpp reads of them.

  export CUTICLE=build/release/bin/cuticle CUTICLE_TEST_DATA=...
  python bench/multiple_scattering/scenes.py OUT [--samples 64]
  build/release/bin/fit_multiple_scattering TABLE.cpp OUT/told_* --held OUT/held_*

Grooms from sparse to dense, lights from all sides, views from all around and colours from clear to black. What OUT has is kept.
"""
import argparse
import concurrent.futures
import fnmatch
import json
import math
import os
import random
import subprocess
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), ".."))
import measured_scenes

SAMPLES = os.environ.get("CUTICLE_SAMPLES", os.path.join(os.path.dirname(measured_scenes.PROGRAM), "multiple_scattering_samples"))
HEAD = {"position_m": [0.42, 0.2, 1.0], "target_m": [0, 0.06, 0], "fov_deg": 27}
OTHER_SIDE = {"position_m": [-0.8, 0.15, 0.7], "target_m": [0, 0.06, 0], "fov_deg": 27}
KEY, BACK, SIDE, TOP, LEFT = (0.6, 0.9, 0.8), (-0.3, 0.6, -1), (1, 0.2, 0.1), (0, 1, 0.15), (-0.7, 0.5, 0.6)
BLOND, UNEVEN, BROWN = (0.06, 0.1, 0.2), (0.02, 0.4, 1.5), (0.5447, 0.9061, 1.781)
DRAWN = [BLOND, UNEVEN, (0.03, 0.15, 0.3), (0.25, 0.5, 1.0), (0.01, 0.06, 0.6)]
# Grown heads of hair: strands per m^2, or a look of scenes/looks; radius in metres.
GROWN = {"D4": ("density=4e5", 8e-5), "D2": ("density=2e5", 8e-5), "D1": ("density=1e5", 8e-5), "D05": ("density=5e4", 8e-5),
         "CU": ("curly", 1.2e-4), "WA": ("wavy", 1.5e-4), "ST": ("straight", 1e-4)}
# Transmittance is also that of the maps that the scenes of the gallery and the ladder have.
SHADOWS = ["deep_opacity:layers=16,resolution=320,filter_radius_mm=1.5", "deep_opacity:layers=8,resolution=512,filter_texels=1"]
LOOKS = os.path.join(os.path.dirname(__file__), "../../scenes/looks")
ON_HEAD = "h"  # in names of cases: with the head that the hair grows on, every strand a fibre
FIBRE_RADIUS = 4e-5
FILES = {"PT": "ponytail", "TH": "testhair", "SI": "sintel"}
CHOSEN = [("D4", KEY, BLOND), ("D4", BACK, UNEVEN), ("D4", SIDE, BROWN), ("D4", TOP, UNEVEN), ("D1", KEY, UNEVEN),
          ("D1", BACK, BLOND), ("D1", SIDE, BLOND), ("D05", KEY, BLOND), ("D05", TOP, UNEVEN), ("D05", BACK, BROWN),
          ("PT", KEY, UNEVEN), ("PT", BACK, BLOND), ("PT", SIDE, BLOND), ("CU", KEY, BLOND), ("CU", SIDE, UNEVEN),
          ("CU", BACK, BLOND), ("SI", KEY, UNEVEN), ("SI", BACK, BLOND)]


def light(chance):
    up, turn = chance.uniform(-0.25, 1), chance.uniform(0, 2 * math.pi)
    flat = math.sqrt(1 - up * up)
    return round(flat * math.cos(turn), 3), round(up, 3), round(flat * math.sin(turn), 3)


def view(groom, chance):
    if groom in ("TH", "SI"):
        return {}
    target, distance = ([0, 0.95, -0.05], 2.6) if groom == "PT" else ([0, 0.06, 0], 1.09)
    turn, rise = chance.uniform(0, 2 * math.pi), chance.uniform(-0.05, 0.45)
    along = (math.sin(turn) * math.cos(rise), math.sin(rise), math.cos(turn) * math.cos(rise))
    return {"position_m": [round(t + distance * a, 4) for t, a in zip(target, along)], "target_m": target, "fov_deg": 27}


def drawn(counts, chance, colour):
    """Cases by chance: groom, light, colour, view; in groups of one groom."""
    groups, before = [], 0
    for groom, count in counts:
        group = []
        for k in range(count):
            camera = view(groom, chance)
            group.append((groom, light(chance), colour(k, before + k), camera))
        groups.append(group)
        before += count
    return groups


def cases():
    """Name, pixels across, rays of a pixel, and groom, light, colour, view."""
    chance = random.Random(5)
    told = drawn([("D4", 7), ("D2", 4), ("D1", 6), ("D05", 5), ("CU", 6), ("PT", 6), ("SI", 4)], chance,
                 lambda k, n: DRAWN[(k + n) % 5])
    more = drawn([("LB", 6)], random.Random(6), lambda k, n: DRAWN[k % 5])
    all_around = drawn([(groom, 12) for groom in ("D4", "D2", "D1", "D05", "CU", "PT", "SI")], random.Random(7),
                       lambda k, n: DRAWN[(k + n) % 5])
    held = drawn([("D4", 2), ("WA", 2), ("TH", 2), ("PT", 1), ("SI", 1), ("D1", 1), ("CU", 1)], chance,
                 lambda k, n: (BLOND, (0.04, 0.25, 0.8))[k % 2])
    for k, case in enumerate(CHOSEN):
        yield f"told_a{k:02d}_{case[0]}", 128, 6, (*case, None)
    for k, case in enumerate(case for group in told for case in group[:4]):
        yield f"told_b{k:02d}_{case[0]}", 64, 6, case
    for k, case in enumerate(case for group in all_around for case in group):
        yield f"told_e{k:02d}_{case[0]}", 64, 6, case
    rest = drawn([(groom, 8) for groom in ("TH", "LB", "WA", "ST")], random.Random(8), lambda k, n: DRAWN[(k + n) % 5])
    for k, case in enumerate(case for group in rest for case in group):
        yield f"told_f{k:02d}_{case[0]}", 64, 6, case
    on_heads = [("D4", 10), ("D2", 5), ("D1", 8), ("D05", 8), ("CU", 8), ("WA", 8), ("ST", 8), ("LB", 8)]
    told_on_heads = drawn(on_heads, random.Random(9), lambda k, n: DRAWN[(k + n) % 5])
    held_on_heads = drawn([(groom, 2) for groom, _ in on_heads], random.Random(10), lambda k, n: (BLOND, (0.04, 0.25, 0.8))[k % 2])
    for k, case in enumerate(case for group in told_on_heads for case in group):
        yield f"told_{ON_HEAD}{k:02d}_{case[0]}", 64, 6, case
    for k, case in enumerate(case for group in held_on_heads for case in group):
        yield f"held_{ON_HEAD}{k:02d}_{case[0]}", 64, 6, case
    for k, case in enumerate(case for group in more for case in group):
        yield f"held_d{k:02d}_{case[0]}", 64, 6, case
    for k, case in enumerate([("ST", KEY, BLOND, None), ("ST", LEFT, (0.02, 0.062, 0.17), OTHER_SIDE)]):
        yield f"held_c{k:02d}_{case[0]}", 96, 4, case
    for k, case in enumerate([("D2", LEFT, BLOND, OTHER_SIDE), ("TH", KEY, BLOND, None)]):
        yield f"held_a{k:02d}_{case[0]}", 128, 6, case
    for k, case in enumerate(case for group in held for case in group):
        yield f"held_b{k:02d}_{case[0]}", 96, 4, case


def groom_of(name, out, fibres):
    """`fibres`: with as many strands as fibres of FIBRE_RADIUS cover the same."""
    settings, radius = GROWN[name]
    times = radius / FIBRE_RADIUS if fibres else 1
    if "=" in settings:
        key, density = settings.split("=")
        path = measured_scenes.grown(f"{key}={float(density) * times:g}", radius / times, out)
    else:
        path = os.path.join(out, f"{settings}_{times:g}.npz")
        if not os.path.exists(path):
            looks = os.path.join(out, f"{settings}_{times:g}.json")
            with open(looks, "w") as file:
                json.dump(measured_scenes.with_strands(os.path.join(LOOKS, f"{settings}.json"), times), file)
            subprocess.run([measured_scenes.PROGRAM, "grow", looks, "--out", path], check=True, capture_output=True)
    return {"file": os.path.abspath(path), "metres_per_unit": 1, "radius_m": radius / times}


def scene_of(case, size, out, fibres):
    groom, to_light, colour, camera = case
    if groom == "LB":
        hair = {"specification": measured_scenes.ladder_of_fibres(out) if fibres else measured_scenes.LADDER}
        scene = measured_scenes.scene("dense", out, colour, size, to_light, groom=hair, camera=camera or HEAD)
        return {**scene, "fibre_count": measured_scenes.LADDER_FIBRES}
    if groom in FILES:
        return measured_scenes.scene(FILES[groom], out, colour, size, to_light, camera=camera)
    return measured_scenes.scene("dense", out, colour, size, to_light, groom=groom_of(groom, out, fibres), camera=camera or HEAD)


def make(case, options):
    name, size, rays, drawn_case = case
    folder = os.path.join(options.out, name)
    if os.path.exists(os.path.join(folder, "about.f64")):
        return
    os.makedirs(folder, exist_ok=True)
    on_head = f"_{ON_HEAD}" in name
    scene = scene_of(drawn_case, size, options.out, on_head)
    if on_head:
        scene["head"] = {"present": True}
    path = measured_scenes.write(scene, os.path.join(folder, "scene.json"))
    print(name, flush=True)
    subprocess.run([SAMPLES, path, folder, str(options.samples), str(rays), *SHADOWS], check=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("out")
    parser.add_argument("--samples", type=int, default=64)
    parser.add_argument("--only", default="*", help="of the cases, by name: '*_h*' those on a head")
    parser.add_argument("--jobs", type=int, default=2, help="pictures at a time")
    options = parser.parse_args()
    os.makedirs(options.out, exist_ok=True)
    for groom in GROWN:
        for fibres in (False, True):
            groom_of(groom, options.out, fibres)
    measured_scenes.ladder_of_fibres(options.out)
    wanted = [case for case in cases() if fnmatch.fnmatch(case[0], options.only)]
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        list(pool.map(lambda case: make(case, options), wanted))


if __name__ == "__main__":
    main()
