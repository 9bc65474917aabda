"""Whether the draws of Mitsuba's `hair` make it brighter than ours where light scatters often (--hair apart).

  apt-get install libllvm19      (for Mitsuba's vectorised variant; libllvm14 and 15 did not work)
  export CUTICLE=build/release/bin/cuticle
  python bench/peers/mitsuba_consistent.py OUT [--bounces 64] [--samples 400] [--batches 8] [--draws 1000000]

Light reflected twice or more inside a fibre should leave around the cone of its inclination, as `eval` and `pdf` say.
`sample` sends it straight across, at a sine of exactly 0. Here a BSDF around `hair` draws those directions anew from
the last lobe of `pdf`, weighs them by eval over pdf, and changes nothing else.

Printed, for light that meets one fibre: the share of draws with sine 0; albedo and mean sine of scattered red light by
`sample` as built in, by `sample` with those drawn anew, and by `eval` (directions by a density of its own). Then ratios
of the picture's mean red, green and blue, with standard errors over batches, each with a seed of its own; the first
ratio compares the same seeds. OUT keeps our pictures: take another folder for other --samples.
"""
import argparse
import math
import os
import sys

import mitsuba as mi
import numpy as np

mi.set_variant("llvm_ad_rgb")

import drjit as dr  # noqa: E402

import compare  # noqa: E402
import mitsuba_picture  # noqa: E402
from mitsuba_sampler import SPREAD, ratio  # noqa: E402

PASS = 50  # samples of a pixel drawn at once


class DrawnAnew(mi.BSDF):
    """`hair` whose last lobe is drawn around the cone of the incoming direction; the fibre is the local y axis."""

    def __init__(self, properties):
        mi.BSDF.__init__(self, properties)
        self.hair = properties["hair"]
        rough = properties["beta_m"]
        self.variance = 4 * (0.726 * rough + 0.812 * rough**2 + 3.7 * rough**20) ** 2  # of the last lobe
        self.m_components = [self.hair.flags(k) for k in range(self.hair.component_count())]
        self.m_flags = self.hair.flags()

    def around(self, sine, random):
        """The sine of an inclination (d'Eon and others, Importance Sampling for Physically-Based Hair Fiber Models)."""
        u = random.x + (1 - random.x) * math.exp(-2 / self.variance)
        along = 1 + self.variance * dr.log(u)
        across = dr.safe_sqrt(1 - along * along) * dr.cos(2 * math.pi * random.y)
        return dr.clip(across * dr.safe_sqrt(1 - sine * sine) - along * sine, -1, 1)

    def sample(self, context, hit, random, randoms, active=True):
        drawn, weight = self.hair.sample(context, hit, random, randoms, active)
        astray = active & (drawn.wo.y == 0) & (drawn.pdf > 0)
        sine = self.around(hit.wi.y, randoms)
        across = dr.safe_sqrt(1 - sine * sine)
        anew = mi.Vector3f(drawn.wo.x * across, sine, drawn.wo.z * across)
        light, density = self.hair.eval_pdf(context, hit, anew, astray)
        drawn.wo, drawn.pdf = dr.select(astray, anew, drawn.wo), dr.select(astray, density, drawn.pdf)
        return drawn, dr.select(astray, dr.select(density > 0, light / density, 0), weight) & active

    def eval(self, context, hit, way, active=True):
        return self.hair.eval(context, hit, way, active)

    def pdf(self, context, hit, way, active=True):
        return self.hair.pdf(context, hit, way, active)


mi.register_bsdf("hair_drawn_anew", DrawnAnew)


def anew(curve, rough):
    return {**curve, "bsdf": {"type": "hair_drawn_anew", "beta_m": rough, "hair": curve["bsdf"]}}


def evaluated(bsdf, hit, random, straight, count):
    """Weights and sines for directions by a normal about straight on or even, half each, at an even azimuth."""
    sine = np.where(random.random(count) < 0.5, random.normal(straight, SPREAD, count), random.uniform(-1, 1, count))
    inside = np.abs(sine) < 1
    density = 0.5 * np.exp(-0.5 * ((sine - straight) / SPREAD) ** 2) / (SPREAD * math.sqrt(2 * math.pi)) + 0.25
    azimuth, across = random.uniform(0, 2 * math.pi, count), np.sqrt(np.maximum(0, 1 - sine**2))
    way = mi.Vector3f(mi.Float(sine), mi.Float(across * np.cos(azimuth)), mi.Float(across * np.sin(azimuth)))
    light = np.array(bsdf.eval(mi.BSDFContext(), hit, hit.to_local(way), mi.Bool(inside))[0])
    return np.where(inside, light * 2 * math.pi / density, 0), sine


def one_fibre(out, fibre, degrees, count):
    path = os.path.join(out, "fibre.txt")
    with open(path, "w") as file:
        file.writelines(f"{x} 0 0 1\n" for x in np.linspace(-200, 200, 12))
    curve, random = mitsuba_picture.hair(fibre, path), np.random.default_rng(7)
    sine, cosine = math.sin(math.radians(degrees)), math.cos(math.radians(degrees))
    side, first, second, third = (mi.Float(random.random(count)) for _ in range(4))
    ray = mi.Ray3f(mi.Point3f(-10 * sine, 10 * cosine, 1.998 * side - 0.999), mi.Vector3f(sine, -cosine, 0))

    def show(name, weights, sines):
        albedo, inclined = ((np.ones(len(weights)), weights), (weights, weights * sines))
        print(f"{degrees} degrees, {name}: albedo {ratio(*albedo)}, mean sine {ratio(*inclined)}", flush=True)

    for name, made in (("built in", curve), ("drawn anew", anew(curve, fibre["beta_m"]))):
        scene = mi.load_dict({"type": "scene", "hair": made})
        hit = scene.ray_intersect(ray)
        good = np.array(hit.is_valid())
        drawn, weight = hit.bsdf().sample(mi.BSDFContext(), hit, first, mi.Point2f(second, third), hit.is_valid())
        across = np.array(drawn.wo.y == 0)[good].mean()
        show(f"{name}, sine 0 in {across:.4f}", np.array(weight[0])[good], np.array(hit.to_world(drawn.wo).x)[good])
    show("eval", *(part[good] for part in evaluated(hit.bsdf(), hit, random, sine, count)))


def light_of(scene, samples, seed):
    """Mean red, green and blue; passes of PASS samples have seeds of their own."""
    passes = max(1, samples // PASS)
    pictures = (np.array(mi.render(scene, spp=min(samples, PASS), seed=seed * passes + k)) for k in range(passes))
    return np.mean([picture[..., :3].mean((0, 1), dtype=float) for picture in pictures], 0)


def over(name, these, those, paired=False):
    """The ratio of means over the batches, with its standard error."""
    found, these, those = these.mean(0) / those.mean(0), these / these.mean(0), those / those.mean(0)
    variance = (these - those).var(0, ddof=1) if paired else these.var(0, ddof=1) + those.var(0, ddof=1)
    error = found * np.sqrt(variance / len(these))
    print(f"{name:28}" + "  ".join(f"{r:.4f} +- {e:.4f}" for r, e in zip(found, error)), flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("out")
    for name, default in (("bounces", 64), ("samples", 400), ("batches", 8), ("draws", 1000000)):
        parser.add_argument(f"--{name}", type=int, default=default)
    options = parser.parse_args()
    out, batches = os.path.abspath(options.out), range(options.batches)
    os.makedirs(out, exist_ok=True)
    scene = compare.prepare(out, 64, "apart")
    fibre = scene["material"]["model"]["chiang"]
    for degrees in (30, 60, 75):
        one_fibre(out, fibre, degrees, options.draws)
    told = mitsuba_picture.described(out, options.bounces)
    scenes = mi.load_dict(told), mi.load_dict({**told, "hair": anew(told["hair"], fibre["beta_m"])})
    built_in, drawn_anew = (np.array([light_of(s, options.samples, seed) for seed in batches]) for s in scenes)
    over("drawn anew over built in", drawn_anew, built_in, paired=True)
    pictures = (compare.ours(scene, out, options.bounces, options.samples, seed) for seed in batches)
    mine = np.array([picture[..., :3].mean((0, 1), dtype=float) for picture in pictures])
    over("built in over ours", built_in, mine)
    over("drawn anew over ours", drawn_anew, mine)


if __name__ == "__main__":
    main()
