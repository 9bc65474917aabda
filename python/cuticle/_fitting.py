"""Parameters of models from measured lobes."""
import json
import math
import typing

import numpy

from . import _cuticle
from ._errors import Error
from ._inputs import numbers, settings
from ._models import _COORDINATES, _coordinates
from ._progress import ticking


class Parameter(typing.NamedTuple):
    """A fitted parameter: value, one standard deviation, the 95 % interval, and whether the data pull it out of its range."""

    value: float
    sigma: float
    interval_95: tuple
    at_bound: bool


class Fit(typing.NamedTuple):
    """parameters: `Parameter` by name; correlations (n, n); residual: rms, in units of sigma where that is known; aic: Akaike's criterion.

    inseparable: groups of names that the data cannot tell apart (a group of one: they do not depend on it); where there are any,
    nothing else is told. settings: all parameters of the model, as `set` takes them.
    """

    model: str
    parameters: dict
    correlations: numpy.ndarray
    residual: float
    aic: float
    numbers: int
    converged: bool
    inseparable: list
    settings: dict


def _fit_of(told):
    parameters = {p["name"]: Parameter(p["value"], p["sigma"], tuple(p["interval_95"]), p["at_bound"]) for p in told["parameters"]}
    count = len(parameters)
    correlations = numpy.array(told.get("correlations", []), float).reshape((count, count) if "correlations" in told else (0, 0))
    aic = math.nan if told["aic"] is None else told["aic"]
    return Fit(told["model"], parameters, correlations, told["residual"], aic, told["numbers"], told["converged"], told["inseparable"], told.get("settings", {}))


def fit(model: str, values, free, set=None, *, preset=None, quantity="S", lobe="sum", sigma=None, loss="squares", theta_i_deg=None,
        theta_o_deg=None, theta_d_deg=None, phi_deg=None, h=None, phi_o_deg=None, progress=None) -> Fit:
    """Fits parameters of a model to measured values of S, M, N, A or albedo, by least squares within their ranges (Ceres).

    values: (n, 3) for red, green and blue, or (n), then of a grey fibre; angles: numbers or (n), as of `eval`. free: names of the
    parameters to find; one component as "sigma_a.r". set, preset: the others, and where the search begins. lobe: one name,
    or (n) of them. sigma: one standard deviation of each value, a number or (n); none: estimated from the residuals. loss: "squares",
    "huber" or "cauchy".
    """
    given = dict(zip(_COORDINATES, (theta_i_deg, theta_o_deg, theta_d_deg, phi_deg, h, phi_o_deg)))
    coordinates = [numpy.atleast_1d(array) for array in _coordinates(model, quantity, preset, set, None, given)]
    measured = numbers("values", values)
    count = len(measured) if measured.ndim else 0
    if measured.ndim not in (1, 2) or any(array.shape not in ((1,), (count,)) for array in coordinates):
        raise Error(f"values: an array of shape {measured.shape}; values are (n) or (n, 3), and angles numbers or (n)", "bad_input")
    coordinates[0] = numpy.ascontiguousarray(numpy.broadcast_to(coordinates[0], (count,)))
    lobes = [lobe] if isinstance(lobe, str) else [str(name) for name in lobe]
    if len(lobes) not in (1, count):
        raise Error(f"lobe: {len(lobes)} names for {count} values", "bad_input")
    deviations = None if sigma is None else numpy.ascontiguousarray(numpy.broadcast_to(numbers("sigma", sigma), (count,)))
    names = free.split(",") if isinstance(free, str) else list(free)
    with ticking(progress, "fit"):
        return _fit_of(json.loads(_cuticle.fit(model, preset or "", settings(set), names, loss, quantity, lobes, coordinates, measured, deviations)))
