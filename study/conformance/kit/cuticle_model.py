"""Cuticle's own Python module behind conformance.py, in single precision: an example of an adapter."""
import math

import cuticle


def evaluate(model, settings, quantity, lobe, theta_i, theta_o, phi, h):
    angles = {name: math.degrees(angle) for name, angle in (("theta_i_deg", theta_i), ("theta_o_deg", theta_o), ("phi_deg", phi))}
    text = ",".join(f"{name}={value}" for name, value in settings.items())
    return tuple(cuticle.eval(model, quantity, lobe, text, h=h, precision="f32", **angles))
