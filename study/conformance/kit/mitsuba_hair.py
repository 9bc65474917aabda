"""Mitsuba 3's BSDF `hair` behind conformance.py: the near field of `chiang`, the sum of S.

Mitsuba's value is S without a further cosine. Its tilt is in degrees and has the opposite sign. pip install mitsuba
"""
import functools
import math

import mitsuba as mi

mi.set_variant("scalar_rgb")


@functools.lru_cache(maxsize=16)
def fibre(eta, beta_m, beta_n, alpha, sigma_a):
    return mi.load_dict({"type": "hair", "int_ior": float(eta), "ext_ior": 1.0, "scale": 1.0, "scale_tilt": -math.degrees(float(alpha)),
                         "sigma_a": {"type": "rgb", "value": [float(each) for each in sigma_a.split("/")]},
                         "longitudinal_roughness": float(beta_m), "azimuthal_roughness": float(beta_n)})


def evaluate(model, settings, quantity, lobe, theta_i, theta_o, phi, h):
    if (model, settings.get("field"), quantity, lobe) != ("chiang", "near", "S", "sum"):
        return None
    at = mi.SurfaceInteraction3f()
    at.t, at.p, at.n, at.wavelengths, at.sh_frame = 1.0, mi.Point3f(0), mi.Normal3f(0, 0, 1), [], mi.Frame3f(mi.Vector3f(0, 0, 1))
    turn = math.asin(max(-1.0, min(1.0, -h)))
    toward = lambda theta, azimuth: mi.Vector3f(math.cos(theta) * math.sin(azimuth), math.sin(theta), math.cos(theta) * math.cos(azimuth))
    at.wi = toward(theta_o, turn)
    bsdf = fibre(*(settings[name] for name in ("eta", "beta_m", "beta_n", "alpha", "sigma_a")))
    return tuple(bsdf.eval(mi.BSDFContext(), at, toward(theta_i, turn - phi)))
