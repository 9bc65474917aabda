"""Lookup tables: baked, fitted, written for engines, read again, checked; shader code."""
import json
import numbers
import os
import typing

from . import _cuticle
from ._errors import Error
from ._inputs import path, settings
from ._models import _check
from ._progress import progress_of, ticking


class AnalyticFit(typing.NamedTuple):
    """code: functions in what GLSL, HLSL and C++ share; lobes: dictionaries with coefficients and errors; manifest: all of it."""

    code: str
    lobes: list
    manifest: dict


def _listed(values):
    return values if isinstance(values, str) else ",".join(values)


def bake(model: str, layout="auto", size=128, set=None, preset=None, *, format="exr", fit="none", out=None, targets=(), progress=None) -> dict:
    """Lookup tables as float32 arrays [v, u, channel] of the values that a shader reads, by name, and under "manifest" what they are:
    axes, channels, their measured errors.

    size: texels each way, 16 .. 1024. format: of their numbers and files (`table_choices()`); fit "texels": least squares
    after the engine's filter, instead of samples. out: a folder to write; targets: engines that it gets folders for.
    progress: True (tqdm) or a function of task, done, total.
    """
    _check(model=(model, str), layout=(layout, str), size=(size, numbers.Integral), preset=(preset or "", str))
    if targets and out is None:
        raise Error("targets: there is no folder to write", "usage", 'out="tables"')
    tables, manifest = _cuticle.bake(model, layout, int(size), preset or "", settings(set), format, fit, _listed(targets),
                                     "" if out is None else path(out), progress_of(progress))
    return {**tables, "manifest": json.loads(manifest)}


def read_tables(folder) -> dict:
    """A folder of tables as `bake` gives it: values by name, and "manifest"."""
    tables, manifest = _cuticle.read_tables(path(folder))
    return {**tables, "manifest": json.loads(manifest)}


def check_tables(folder, *, progress=None) -> dict:
    """Whether a folder of tables still says what its manifest says: "passed", and for each table the verdict, with the mistake of an
    import by name."""
    with ticking(progress, "check_tables"):
        return json.loads(_cuticle.check_tables(path(folder)))


def snippet(folder, dialect="glsl") -> str:
    """Shader text that reads a folder of tables and puts S together: "glsl", "hlsl" or "wgsl"."""
    return _cuticle.snippet(os.fspath(folder), dialect)


def fit_analytic(model: str = "marschner", set=None, preset=None, *, progress=None) -> AnalyticFit:
    """M and N of a far-field model without textures: a few Gaussians for each lobe, with their errors."""
    code, text = _cuticle.analytic(model, preset or "", settings(set), progress_of(progress))
    manifest = json.loads(text)
    return AnalyticFit(code, manifest.get("lobes", []), manifest)


def table_choices() -> dict:
    """What `bake` and `snippet` take: "formats", "targets" (engines) and "dialects"."""
    return json.loads(_cuticle.table_choices())
