"""Hair reflectance and strands: the same functions that the program `cuticle` has, on numpy arrays.

Angles are in degrees where a name ends in `_deg`; everything else is SI. Bad input raises ValueError with the program's message.
"""
import json

import numpy

from . import _cuticle
from ._cuticle import Groom, load_groom

__all__ = ["Groom", "absorption_of_assembly", "absorption_of_fibre", "absorption_of_pigments", "bake", "check_model", "eval", "hair_mapping", "hairs", "load_groom", "lobes", "models"]


def _text(value):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (tuple, list, numpy.ndarray)):
        return "/".join(_text(part) for part in value)
    return str(value)


def _settings(values):
    """{"eta": 1.55, "sigma_a": (0.1, 0.2, 0.4)} as the program's --set takes it; a text goes through."""
    if values is None or isinstance(values, str):
        return values or ""
    return ",".join(f"{name}={_text(value)}" for name, value in values.items())


def _numbers(value):
    return numpy.asarray(value, dtype=numpy.float64, order="C")


def models():
    """The registered models: a list of dictionaries with name, summary, source, parameters (unit, range, default), lobes, conventions,
    presets and exceptions."""
    return json.loads(_cuticle.models_json())


def lobes(model):
    """Names of a model's lobes."""
    return _cuticle.lobes(model)


def hairs():
    """Names of the fibres that models can be given as `hair`."""
    return _cuticle.hairs()


def hair_mapping(model, hair):
    """(settings, words): a named fibre in a model's own parameters, and how they came about."""
    return _cuticle.hair_mapping(model, hair)


def absorption_of_pigments(table, eumelanin, pheomelanin=0.0):
    """sigma_a (r, g, b) of two concentrations by a named table, "deon_pbrt" or "blender"."""
    return _cuticle.absorption_of_pigments(table, eumelanin, pheomelanin)


def absorption_of_assembly(color, beta_n=0.3):
    """sigma_a with which a dense head of hair shows the colour (Chiang et al. 2016), for the azimuthal roughness beta_n."""
    return _cuticle.absorption_of_assembly(tuple(color), beta_n)


def absorption_of_fibre(model, color, set=None):
    """sigma_a with which one fibre of the model scatters these shares of the light, for a viewer at theta_o = 0."""
    return _cuticle.absorption_of_fibre(model, tuple(color), _settings(set))


def eval(model, quantity, lobe="sum", set=None, *, preset=None, hair=None, theta_i_deg=0.0, theta_o_deg=0.0, theta_d_deg=0.0, phi_deg=0.0,
         h=0.0, phi_o_deg=0.0, precision="f64"):
    """A model's quantity: "S", "M", "N", "A", "albedo", "pdf" or "error", without the cosine of the incident angle.

    The angles (numbers or arrays; h in [-1, 1]) are broadcast together; the result has their shape with an axis of r, g, b added.
    S, pdf and error use theta_i, theta_o, phi; M theta_i, theta_o; N theta_d, phi; A theta_d, h; albedo theta_o. Near-field models use h
    too, and fibres of elliptical cross-section phi_o, the viewer's azimuth from the major axis.
    `set` is a dictionary or a text "eta=1.55,sigma_a=0.1/0.2/0.4" over the preset, the named hair or the defaults; `precision` is "f32" or
    "f64".
    """
    coordinates = [_numbers(value) for value in (theta_i_deg, theta_o_deg, theta_d_deg, phi_deg, h, phi_o_deg)]
    return _cuticle.evaluate(model, quantity, lobe, preset or "", _settings(set), hair or "", coordinates, precision)


def check_model(model, *, pdf=None, sample=None, albedo=None, near_field=False, white=False, complete=False, set=None, preset=None,
                precision="f64", quick=False):
    """The checks of `cuticle check model`: a dictionary with model, sound, cause, cause_words and checks.

    `model` is the name of a registered model (with `set`, `preset`, `precision`), or a function S(theta_i, theta_o, phi, h) of arrays in
    radians; then `pdf` is a function of the same arguments, `sample` one of theta_o, h and u (rows of eight numbers) that returns
    theta_i, phi, pdf and weight, `albedo` one of theta_o and h. `white`: the functions absorb nothing; `complete`: all orders of
    scattering are in them; `quick`: fewer directions and samples.
    """
    if isinstance(model, str):
        text = _cuticle.check_registered(model, preset or "", _settings(set), precision, quick)
    else:
        text = _cuticle.check_functions(model, pdf, sample, albedo, near_field, white, complete, quick)
    return json.loads(text)[0]


def bake(model, layout="nalu", size=128, set=None, preset=None):
    """Lookup tables as half-float values in float arrays [v, u, channel], by name, and under "manifest" what they are."""
    tables, manifest = _cuticle.bake(model, layout, size, preset or "", _settings(set))
    return {**tables, "manifest": json.loads(manifest)}
