"""Shadow methods on arrays of points: how much of a light reaches them through hair."""
import warnings

import numpy

from . import _cuticle
from ._errors import Error
from ._inputs import floats, numbers, to_json, triple
from ._progress import ticking
from ._registries import methods

__all__ = ["footprint_radius", "methods", "transmittance", "truth"]


def transmittance(groom, light=(0, 1, 0), points=None, method="deep_opacity", *, alpha=0.4, point_light=False, seen_from=None, camera=None, receivers=2000,
                  fibre_width=1.0, details=False, progress=None, **settings):
    """Transmittance of light to points, 0 .. 1, by a shadow method (`cuticle.methods()`) with its parameters by name.

    light: direction to the light (of any length), or with point_light=True its place in metres. points: (n, 3), metres; none: the
    groom's vertices, where a fibre does not shadow itself. seen_from: a viewer's place, metres, who sees these vertices' surface,
    as pictures do. camera: direction to an orthographic camera, instead: at most `receivers` points that its pixels see. alpha:
    opacity of one fibre crossing, 0 .. 1, or (3) for red, green and blue. fibre_width: of the fibres that a strand stands for, as a
    share of the strand's width, 0 .. 1: at the groom's own points what lies within such a fibre is left out (the truth knows strands
    alone). Result: float32 (n), or (n, 3) of three opacities; with
    details a dictionary with values, points, clamped, build_ms, lookup_ms, bytes, device and, of the truth, standard_error and
    occluders (metres). progress: True (tqdm) or a function of task, done, total.

        cuticle.shadows.transmittance(groom, (1, 1, 0.3), points, method="deep_opacity", layers=16, resolution=512)
        cuticle.shadows.transmittance(groom, (1, 1, 0.3), camera=(1, 0.3, 1), alpha=1, resolution=512).mean()
    """
    if "lamp" in settings:
        warnings.warn("'lamp' is called 'point_light' now; the next version no longer reads the former name", stacklevel=2)
        point_light = settings.pop("lamp")
    if not 0 <= fibre_width <= 1:
        raise Error(f"fibre_width = {fibre_width}: outside 0 .. 1")
    arguments = (triple("light", light), bool(point_light), *_places(points, seen_from, camera, receivers), float(fibre_width))
    opacity = numbers("alpha", alpha)
    if opacity.ndim == 0:
        with ticking(progress, method):
            result = _cuticle.transmittance(groom, method, to_json(settings), float(opacity), *arguments)
        return result if details else result["values"]
    if details:
        raise Error("details: of one opacity only")
    with ticking(progress, method):
        return _cuticle.coloured_transmittance(groom, method, to_json(settings), triple("alpha", alpha), *arguments)


def _places(points, seen_from, camera, receivers):
    """Where transmittance is asked for, as _cuticle takes it."""
    given = [name for name, value in (("points", points), ("seen_from", seen_from), ("camera", camera)) if value is not None]
    if len(given) > 1:
        raise Error(f"{' and '.join(given)}: one of points, seen_from (of the groom's vertices) and camera")
    if not 1 <= receivers <= 10_000_000:
        raise Error(f"receivers = {receivers}: outside 1 .. 10000000")
    return (None if points is None else floats("points", points, 3), None if seen_from is None else triple("seen_from", seen_from),
            None if camera is None else _direction("camera", camera), int(receivers))


def _direction(name, value):
    found = triple(name, value)
    if not 0 < numpy.linalg.norm(found) < numpy.inf:
        raise Error(f"{name}: direction {tuple(found)} must be finite and not zero")
    return found


def truth(groom, light=(0, 1, 0), points=None, *, rays=1024, footprint_radius_mm=0.0, **arguments):
    """Ray-traced transmittance and its standard error, float32 (n) each: the mean over a disc of rays to the light (Embree).
    footprint_radius_mm 0: two strand spacings; of what a camera sees one ray from each point. Other arguments as of `transmittance`."""
    if "truth" not in (method["name"] for method in methods()):
        raise Error("truth: this build has no Embree (try: build where libembree-dev is installed)", "usage")
    result = transmittance(groom, light, points, "truth", details=True, rays=rays, footprint_radius_mm=footprint_radius_mm, **arguments)
    return result["values"], result.get("standard_error", numpy.zeros(0, numpy.float32))


def footprint_radius(groom) -> float:
    """Radius in metres of the disc that the truth averages over unless one is given."""
    return _cuticle.footprint_radius(groom)
