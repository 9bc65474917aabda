"""Fibre scattering models: values, directions, densities, derivatives."""
import csv
import io
import json
import typing

import numpy

from . import _cuticle
from ._errors import Error
from ._inputs import floats, numbers as numbers_of, settings, single
from ._progress import progress_of, ticking

# What eval takes; angles in degrees.
_COORDINATES = ("theta_i_deg", "theta_o_deg", "theta_d_deg", "phi_deg", "h", "phi_o_deg")


class Samples(typing.NamedTuple):
    """Incident directions: theta_i_deg, phi_deg, pdf (1/sr), weight (n, 3) = S / pdf, and lobe (-1: none alone)."""

    theta_i_deg: numpy.ndarray
    phi_deg: numpy.ndarray
    pdf: numpy.ndarray
    weight: numpy.ndarray
    lobe: numpy.ndarray


class Gradients(typing.NamedTuple):
    """values (..., 3) and derivatives: by the name of each parameter, an array (..., 3), per unit of the parameter."""

    values: numpy.ndarray
    derivatives: dict


def models() -> list:
    """The registered models: a list of dictionaries with name, summary, source, parameters (unit, range, default), lobes, conventions,
    presets and exceptions."""
    return json.loads(_cuticle.models_json())


def lobes(model: str) -> list:
    """Names of a model's lobes."""
    return _cuticle.lobes(model)


def hairs() -> list:
    """Names of the fibres that models can be given as `hair`."""
    return _cuticle.hairs()


def hair_mapping(model: str, hair: str) -> tuple:
    """(settings, words): a named fibre in a model's own parameters, and how they came about."""
    return _cuticle.hair_mapping(model, hair)


def absorption_of_pigments(table: str, eumelanin: float, pheomelanin: float = 0.0) -> tuple:
    """sigma_a (r, g, b) of two concentrations by a named table, "deon_pbrt" or "blender"."""
    return _cuticle.absorption_of_pigments(table, eumelanin, pheomelanin)


def absorption_of_assembly(color, beta_n: float = 0.3) -> tuple:
    """sigma_a with which a dense head of hair shows the colour (Chiang et al. 2016), for the azimuthal roughness beta_n."""
    return _cuticle.absorption_of_assembly(tuple(color), beta_n)


def absorption_of_fibre(model: str, color, set=None) -> tuple:
    """sigma_a with which one fibre of the model scatters these shares of the light, for a viewer at theta_o = 0."""
    return _cuticle.absorption_of_fibre(model, tuple(color), settings(set))


def _check(**arguments):
    """TypeError for arguments of another type than is wanted: name = (value, type)."""
    for name, (value, wanted) in arguments.items():
        if not isinstance(value, wanted) or isinstance(value, bool):
            raise TypeError(f"{name}: {value!r:.60} is not {'a text' if wanted is str else 'a whole number'}")


def _angles(given, needed, what):
    """The arrays that eval hands on: what is needed must be given; the compiled half checks the ranges."""
    missing = [name for name in _COORDINATES if name.removesuffix("_deg") in needed and given[name] is None]
    if missing:
        raise Error(f"{what} needs {', '.join(missing)}")
    return [numbers_of(name, 0.0 if given[name] is None else given[name]) for name in _COORDINATES]


def _coordinates(model, quantity, preset, set, hair, given):
    needed = _cuticle.needed(model, quantity, preset or "", settings(set), hair or "")
    return _angles(given, needed, f"{quantity} of {model}")


def eval(model, quantity, lobe="sum", set=None, *, preset=None, hair=None, theta_i_deg=None, theta_o_deg=None, theta_d_deg=None,
         phi_deg=None, h=None, phi_o_deg=None, precision="f64", together=None, progress=None) -> numpy.ndarray:
    """A model's quantity: "S", "M", "N", "A", "albedo", "pdf" or "error", without the cosine of the incident angle.

    The angles (numbers or arrays; h in [-1, 1]) are broadcast together; the result has their shape with an axis of r, g, b added.
    S, pdf and error need theta_i, theta_o, phi; M theta_i, theta_o; N theta_d, phi; A theta_d, h; albedo theta_o. Near-field models need h
    too; fibres of elliptical cross-section use phi_o, the viewer's azimuth from the major axis (0 unless given).
    `set` is a dictionary or a text "eta=1.55,sigma_a=0.1/0.2/0.4" over the preset, the named hair or the defaults; `precision` is "f64", or
    "f32": S and pdf of all lobes then go through the vectorised batch. `Batch` takes and gives float32 without a copy. `together`, a whole number: S of
    huang, the lights of each viewer together by that many times its paths, many times faster than point by point. progress: True (tqdm)
    or a function of task, done, total.
    """
    _check(model=(model, str), quantity=(quantity, str), lobe=(lobe, str), preset=(preset or "", str), hair=(hair or "", str),
           precision=(precision, str), together=(1 if together is None else together, int))
    given = dict(zip(_COORDINATES, (theta_i_deg, theta_o_deg, theta_d_deg, phi_deg, h, phi_o_deg)))
    coordinates = _coordinates(model, quantity, preset, set, hair, given)
    return _cuticle.evaluate(model, quantity, lobe, preset or "", settings(set), hair or "", coordinates, precision, together, progress_of(progress))


def conformance(model: str, *, progress=None) -> list:
    """What an implementation of a model elsewhere must give: a dictionary for each value, with settings, quantity, lobe, theta_i_deg, theta_o_deg,
    phi_deg, h, r, g, b, tolerance (the largest difference of a channel) and hard. `cuticle conformance` writes the same as files, with a script."""
    with ticking(progress, "conformance"):
        rows = list(csv.DictReader(io.StringIO(_cuticle.conformance(model))))
    words = ("model", "settings", "quantity", "lobe")
    return [{name: value if name in words else bool(int(value)) if name == "hard" else float(value) for name, value in row.items()} for row in rows]


def pdf(model: str, set=None, **arguments) -> numpy.ndarray:
    """Density of `sample` per steradian of incident directions; arguments as of `eval`, the result without an axis of colours."""
    return eval(model, "pdf", set=set, **arguments)[..., 0]


def albedo(model: str, theta_o_deg, set=None, **arguments) -> numpy.ndarray:
    """Energy scattered to theta_o, (..., 3); arguments as of `eval`."""
    return eval(model, "albedo", set=set, theta_o_deg=theta_o_deg, **arguments)


def sample(model: str, theta_o_deg, u, set=None, *, preset=None, h=0.0, phi_o_deg=0.0, precision="f64", progress=None) -> Samples:
    """Incident directions drawn for viewers at theta_o_deg: the mean of the weights is the albedo.

    u: (n, 8) numbers in [0, 1); theta_o_deg, h and phi_o_deg: numbers or (n).
    """
    numbers_u = numbers_of("u", u)
    if numbers_u.ndim != 2 or numbers_u.shape[1] != 8:
        raise Error(f"u: an array of shape {numbers_u.shape}, not (n, 8)")
    if precision not in ("f32", "f64"):
        raise Error(f"precision '{precision}' is not one of f32, f64")
    count = len(numbers_u)
    theta, offset, azimuth = (numpy.ascontiguousarray(numpy.broadcast_to(numbers_of(name, value), (count,)))
                              for name, value in (("theta_o_deg", theta_o_deg), ("h", h), ("phi_o_deg", phi_o_deg)))
    with ticking(progress, "sample"):
        drawn = _cuticle.sample(model, preset or "", settings(set), precision == "f32", numpy.radians(theta), offset, numpy.radians(azimuth), numbers_u)
    return Samples(numpy.degrees(drawn[0]), numpy.degrees(drawn[1]), *drawn[2:])


def gradients(model: str, quantity: str = "S", by=(), lobe="sum", set=None, *, preset=None, theta_i_deg=None, theta_o_deg=None,
              theta_d_deg=None, phi_deg=None, h=None, phi_o_deg=None, progress=None) -> Gradients:
    """S, M, N or A with its derivatives by parameters (`by`, names; none: all numbers of the model), through the formulas by automatic
    differentiation (ceres::Jet). An rgb gives three: "sigma_a.r", "sigma_a.g", "sigma_a.b". Points as of `eval`."""
    given = dict(zip(_COORDINATES, (theta_i_deg, theta_o_deg, theta_d_deg, phi_deg, h, phi_o_deg)))
    coordinates = _coordinates(model, quantity, preset, set, None, given)
    with ticking(progress, "gradients"):
        names, values, derivatives = _cuticle.gradients(model, quantity, lobe, preset or "", settings(set), list(by), coordinates)
    return Gradients(values, {name: derivatives[..., i] for i, name in enumerate(names)})


class Batch:
    """A model with its parameters, ready for large arrays: float32, as vectorised loops, on all threads, without copies.

    Directions are arrays (3, n) of unit vectors in the fibre's frame, x along it from root to tip; h is (n), of near-field
    models. `out` takes the results where it is given. Arrays that are not float32 and contiguous are copied.
    """

    def __init__(self, model: str, set=None, preset=None):
        self._batch = _cuticle.Batch(model, preset or "", settings(set))

    @staticmethod
    def _arrays(to_light, to_viewer, h):
        return (single(to_light), single(to_viewer), None if h is None else floats("h", h))

    def eval(self, to_light, to_viewer, h=None, out=None) -> numpy.ndarray:
        """S, (3, n): r, g, b, without the cosine of the incident angle."""
        arrays = self._arrays(to_light, to_viewer, h)
        out = numpy.empty_like(arrays[0]) if out is None else out
        self._batch.evaluate(*arrays, out)
        return out

    def pdf(self, to_light, to_viewer, h=None, out=None) -> numpy.ndarray:
        """Density of `sample`, (n), per steradian."""
        arrays = self._arrays(to_light, to_viewer, h)
        out = numpy.empty(arrays[0].shape[1], numpy.float32) if out is None else out
        self._batch.pdf(*arrays, out)
        return out

    def sample(self, to_viewer, u, h=None, out=None) -> numpy.ndarray:
        """Unit vectors toward the light, (3, n), drawn by u, (8, n) numbers in [0, 1)."""
        to_viewer = single(to_viewer)
        out = numpy.empty_like(to_viewer) if out is None else out
        self._batch.sample(to_viewer, None if h is None else floats("h", h), single(u), out)
        return out


def check_model(model, *, pdf=None, sample=None, albedo=None, near_field=False, white=False, complete=False, set=None, preset=None,
                precision="f64", quick=False, progress=None) -> dict:
    """The checks of `cuticle check model`: a dictionary with model, sound, cause, cause_words and checks.

    `model` is the name of a registered model (with `set`, `preset`, `precision`), or a function S(theta_i, theta_o, phi, h) of arrays in
    radians; then `pdf` is a function of the same arguments, `sample` one of theta_o, h and u (rows of eight numbers) that returns
    theta_i, phi, pdf and weight, `albedo` one of theta_o and h. `white`: the functions absorb nothing; `complete`: all orders of
    scattering are in them; `quick`: fewer directions and samples; `progress`: True (tqdm) or a function of task, done, total.
    """
    if isinstance(model, str):
        text = _cuticle.check_registered(model, preset or "", settings(set), precision, quick, progress_of(progress))
    else:
        text = _cuticle.check_functions(model, pdf, sample, albedo, near_field, white, complete, quick, progress_of(progress))
    return json.loads(text)[0]
