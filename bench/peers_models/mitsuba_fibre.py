"""The model `chiang` (near field) against Mitsuba's BSDF `hair`, at random directions and offsets.

  pip install mitsuba numpy        (in a virtual environment of its own)
  CUTICLE=build/release/bin/cuticle python bench/peers_models/mitsuba_fibre.py [--count 2000]

Mitsuba's value is S without a further cosine; its tilt is in degrees and has the opposite sign. It sums I0 by ten terms and caps what it divides by, so
that it is not exact where the lobes are narrow.
"""
import argparse
import math

import mitsuba as mi
import numpy as np

from cuticle_eval import evaluate, summary

mi.set_variant("scalar_rgb")


def mitsuba_values(roughness, sigma_a, tilt_deg, theta_i, theta_o, phi, h):
    bsdf = mi.load_dict({"type": "hair", "int_ior": 1.55, "ext_ior": 1.0, "sigma_a": {"type": "rgb", "value": sigma_a}, "scale": 1.0,
                         "longitudinal_roughness": roughness[0], "azimuthal_roughness": roughness[1], "scale_tilt": tilt_deg})
    context, at = mi.BSDFContext(), mi.SurfaceInteraction3f()
    at.t, at.p, at.n, at.wavelengths = 1.0, mi.Point3f(0), mi.Normal3f(0, 0, 1), []
    at.sh_frame = mi.Frame3f(mi.Vector3f(0, 0, 1))

    def one(i, o, p, offset):
        turn, c = math.asin(-offset), math.cos(o)
        at.wi = mi.Vector3f(c * math.sin(turn), math.sin(o), c * math.cos(turn))
        c = math.cos(i)
        return list(bsdf.eval(context, at, mi.Vector3f(c * math.sin(turn - p), math.sin(i), c * math.cos(turn - p))))

    return np.array([one(*each) for each in zip(theta_i, theta_o, phi, h)])


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--count", type=int, default=2000)
    count = parser.parse_args().count
    random = np.random.default_rng(5)
    theta_i, theta_o = (np.arcsin(random.uniform(-0.98, 0.98, count)) for _ in range(2))
    phi, h = random.uniform(-np.pi, np.pi, count), random.uniform(-0.99, 0.99, count)
    degrees = {"theta_i": np.degrees(theta_i), "theta_o": np.degrees(theta_o), "phi": np.degrees(phi), "h": h}
    print(f"chiang, near field, against Mitsuba {mi.__version__}'s hair at {count} points")
    for roughness in ((0.15, 0.15), (0.3, 0.3), (0.3, 0.6), (0.6, 0.3), (0.9, 0.9)):
        for tilt in (0.0, 2.0):
            sigma_a = [0.06, 0.1, 0.2]
            settings = f"field=near,eta=1.55,beta_m={roughness[0]},beta_n={roughness[1]},alpha_deg={tilt},sigma_a=0.06/0.1/0.2"
            summary(f"beta_m {roughness[0]}, beta_n {roughness[1]}, tilt {tilt} degrees", evaluate("chiang", settings, "S", **degrees),
                    mitsuba_values(roughness, sigma_a, -tilt, theta_i, theta_o, phi, h))


main()
