"""Hair reflectance and strands: the same functions that the program `cuticle` has, on numpy arrays.

Angles are in degrees where a name ends in `_deg`; everything else is SI. Bad input raises ValueError with the program's message.
"""
import json
import numbers
import os

import numpy

from . import _cuticle
from ._cuticle import Groom

# What eval takes, each with the largest magnitude; angles in degrees (a right angle may be off by rounding).
_LIMITS = {"theta_i_deg": 90 * (1 + 1e-12), "theta_o_deg": 90 * (1 + 1e-12), "theta_d_deg": 90 * (1 + 1e-12), "phi_deg": 5.7e7, "h": 1.0,
           "phi_o_deg": 5.7e7}

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


def _numbers(name, value):
    """An array of numbers; what merely converts to one (None, texts, dates, truth values) is refused."""
    array = numpy.asarray(value)
    if array.dtype.kind not in "iuf":
        raise TypeError(f"{name}: {value!r:.60} is no number and no array of numbers")
    return numpy.ascontiguousarray(array, dtype=numpy.float64).reshape(array.shape)


def _angles(given, needed, what):
    """The arrays that eval hands on: what is needed must be given, and lie within its range."""
    missing = [name for name in _LIMITS if name.removesuffix("_deg") in needed and given[name] is None]
    if missing:
        raise ValueError(f"{what} needs {', '.join(missing)}")
    arrays = []
    for name, limit in _LIMITS.items():
        values = _numbers(name, 0.0 if given[name] is None else given[name])
        outside = ~(numpy.abs(values) <= limit)
        if outside.any():
            raise ValueError(f"{name}: {values[outside].flat[0]} is outside -{limit:g} .. {limit:g}")
        arrays.append(values)
    return arrays


def _check(**arguments):
    """TypeError for arguments of another type than is wanted: name = (value, type)."""
    for name, (value, wanted) in arguments.items():
        if not isinstance(value, wanted) or isinstance(value, bool):
            raise TypeError(f"{name}: {value!r:.60} is not {'a text' if wanted is str else 'a whole number'}")


def _path(value):
    path = os.fspath(value)
    return path if isinstance(path, str) else os.fsdecode(path)


def load_groom(path, metres_per_unit=0.0, radius=0.0):
    """Reads a groom file by its ending, as Groom. metres_per_unit 0: as it states, or guessed (see notes); radius 0: the file's own, or
    35e-6 m."""
    return _cuticle.load_groom(_path(path), metres_per_unit, radius)


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


def eval(model, quantity, lobe="sum", set=None, *, preset=None, hair=None, theta_i_deg=None, theta_o_deg=None, theta_d_deg=None,
         phi_deg=None, h=None, phi_o_deg=None, precision="f64"):
    """A model's quantity: "S", "M", "N", "A", "albedo", "pdf" or "error", without the cosine of the incident angle.

    The angles (numbers or arrays; h in [-1, 1]) are broadcast together; the result has their shape with an axis of r, g, b added.
    S, pdf and error need theta_i, theta_o, phi; M theta_i, theta_o; N theta_d, phi; A theta_d, h; albedo theta_o. Near-field models need h
    too; fibres of elliptical cross-section use phi_o, the viewer's azimuth from the major axis (0 unless given).
    `set` is a dictionary or a text "eta=1.55,sigma_a=0.1/0.2/0.4" over the preset, the named hair or the defaults; `precision` is "f32" or
    "f64".
    """
    _check(model=(model, str), quantity=(quantity, str), lobe=(lobe, str), preset=(preset or "", str), hair=(hair or "", str),
           precision=(precision, str))
    given = {"theta_i_deg": theta_i_deg, "theta_o_deg": theta_o_deg, "theta_d_deg": theta_d_deg, "phi_deg": phi_deg, "h": h,
             "phi_o_deg": phi_o_deg}
    needed = _cuticle.needed(model, quantity, preset or "", _settings(set), hair or "")
    coordinates = _angles(given, needed, f"{quantity} of {model}")
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


def bake(model, layout="auto", size=128, set=None, preset=None):
    """Lookup tables as half-float values in float arrays [v, u, channel], by name, and under "manifest" what they are."""
    _check(model=(model, str), layout=(layout, str), size=(size, numbers.Integral), preset=(preset or "", str))
    tables, manifest = _cuticle.bake(model, layout, int(size), preset or "", _settings(set))
    return {**tables, "manifest": json.loads(manifest)}
