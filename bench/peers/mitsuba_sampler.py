"""Whether Mitsuba's `hair` draws the directions that it evaluates: python mitsuba_sampler.py [COUNT]

Of light scattered by one fibre (the hair of compare.py, h even over the width): mean sine of the inclination to the fibre, weighed by red light, by its
`sample` and by its `eval`, with standard errors. Directions for `eval` are drawn by a density that is divided out.
"""
import math
import os
import sys
import tempfile

import mitsuba as mi
import numpy as np

import mitsuba_picture

SPREAD = 0.25  # of the sine about that of straight on, of half of the directions for `eval`
FIBRE = {"eta": 1.55, "sigma_a": [0.06, 0.1, 0.2], "beta_m": 0.3, "beta_n": 0.3}


def ratio(weights, sines):
    mean = sines.sum() / weights.sum()
    error = np.std(sines - mean * weights) / weights.mean() / math.sqrt(len(weights))
    return f"{mean:.4f} +- {error:.4f}"


def drawn(random, straight):
    """A sine and its density."""
    sine = random.normal(straight, SPREAD) if random.random() < 0.5 else random.uniform(-1, 1)
    bell = math.exp(-0.5 * ((sine - straight) / SPREAD) ** 2) / (SPREAD * math.sqrt(2 * math.pi))
    return sine, 0.5 * bell + (0.25 if abs(sine) < 1 else 0)


def evaluated(bsdf, context, hit, random, straight):
    sine, density = drawn(random, straight)
    if abs(sine) >= 1:
        return 0.0, 0.0
    azimuth, across = random.uniform(0, 2 * math.pi), math.sqrt(1 - sine * sine)
    way = mi.Vector3f(sine, across * math.cos(azimuth), across * math.sin(azimuth))
    weight = bsdf.eval(context, hit, hit.to_local(way))[0] * 2 * math.pi / density
    return weight, weight * sine


def compare(scene, random, degrees, count):
    context, sine, cosine = mi.BSDFContext(), math.sin(math.radians(degrees)), math.cos(math.radians(degrees))
    by_sample, by_eval = [], []
    for _ in range(count):
        ray = mi.Ray3f(mi.Point3f(-10 * sine, 10 * cosine, random.uniform(-0.999, 0.999)), mi.Vector3f(sine, -cosine, 0))
        hit = scene.ray_intersect(ray)
        if not hit.is_valid():  # at the fibre's rim
            continue
        sample, weight = hit.bsdf().sample(context, hit, random.random(), mi.Point2f(random.random(), random.random()))
        by_sample.append((weight[0], weight[0] * hit.to_world(sample.wo)[0]))
        by_eval.append(evaluated(hit.bsdf(), context, hit, random, sine))
    by_sample, by_eval = np.array(by_sample).T, np.array(by_eval).T
    print(f"{degrees:2} degrees: sample {ratio(*by_sample)}, eval {ratio(*by_eval)}", flush=True)


def main():
    mi.set_variant("scalar_rgb")
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "fibre.txt")
        with open(path, "w") as out:
            out.writelines(f"{x} 0 0 1\n" for x in np.linspace(-200, 200, 12))
        scene = mi.load_dict({"type": "scene", "hair": mitsuba_picture.hair(FIBRE, path)})
    for degrees in (30, 60, 75):
        compare(scene, np.random.default_rng(7), degrees, int(sys.argv[1]) if len(sys.argv) > 1 else 100000)


if __name__ == "__main__":
    main()
