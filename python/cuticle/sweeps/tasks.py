"""What an item of a sweep can be: a function of named parameters whose result is a dictionary of numbers, texts and arrays.

Names of results that begin with "run_" are of the run (times), not of the result: they may differ from run to run.
"""
import hashlib
import importlib
import inspect
import json
import os

import numpy

from .. import _grooms, _models, _rendering, _simulation, shadows as _shadows
from .._errors import Error
from .._inputs import document

_RESERVED = {"index", "plan", "key", "parameters"}


class Task:
    """name, summary, function, needs_device (one at a time on each machine's device) and takes_folder (of relative paths)."""

    def __init__(self, name, function, summary="", needs_device=False):
        self.name, self.function, self.needs_device = name, function, needs_device
        self.summary = summary or (inspect.getdoc(function) or "").split("\n")[0]
        parameters = inspect.signature(function).parameters.values()
        self.takes_folder = any(p.name == "folder" for p in parameters)
        self.takes_all = any(p.kind is p.VAR_KEYWORD for p in parameters)
        self.names = [p.name for p in parameters if p.kind in (p.POSITIONAL_OR_KEYWORD, p.KEYWORD_ONLY) and p.name != "folder"]
        self.needed = [p.name for p in parameters if p.default is p.empty and p.kind in (p.POSITIONAL_OR_KEYWORD, p.KEYWORD_ONLY)]
        self.identity = name if name in _TASKS else f"{name} {_text_digest(function)}"

    def check_names(self, given):
        """Error: usage for a name that the task does not take, or one that it needs."""
        unknown = [name for name in given if name not in self.names] if not self.takes_all else []
        missing = [name for name in self.needed if name not in given]
        if unknown or missing:
            what = f"no parameter '{unknown[0]}'" if unknown else f"'{missing[0]}' is not given"
            raise Error(f"task '{self.name}': {what}; it takes {', '.join(self.names)}", "usage")

    def __call__(self, parameters, folder):
        result = self.function(**parameters, **({"folder": folder} if self.takes_folder else {}))
        if not isinstance(result, dict):
            result = {"value": result}
        if bad := _RESERVED & set(result):
            raise Error(f"task '{self.name}': a result may not be called {bad.pop()}", "usage")
        return result


def _text_digest(function):
    """A function of the user's own is another task when its text changes."""
    try:
        text = inspect.getsource(function).encode()
    except (OSError, TypeError):
        text = getattr(getattr(function, "__code__", None), "co_code", repr(function).encode())
    return hashlib.sha256(text).hexdigest()[:16]


def _groom_of(groom, folder):
    """A Groom, a file's path, or a grooming specification (a dictionary; {} is the default)."""
    if isinstance(groom, (str, os.PathLike)):
        return _grooms.load_groom(os.path.join(folder, groom))
    return _grooms.grow(groom) if isinstance(groom, dict) else groom


def _eval(**arguments):
    """A model's quantity at angles: the arguments of `cuticle.eval`; `value`, or `r`, `g`, `b` of a single point."""
    value = _models.eval(**arguments)
    return dict(zip("rgb", value.tolist())) if value.ndim == 1 else {"value": value}


def _bake(model, layout="auto", size=128, set=None, preset=None):
    """Lookup tables as arrays, `error` (of S read from them, or of the worst channel; rms over rms) and their manifest as text."""
    tables = _models.bake(model, layout, size, set, preset)
    manifest = tables.pop("manifest")
    of_s = [entry["rms_over_rms"] for name, entry in manifest.get("scattering", {}).items() if name.startswith("S.")]
    of_channels = [channel["error"]["rms_over_rms"] for table in manifest["tables"] for channel in table["channels"] if "error" in channel]
    return {**tables, "error": max(of_s or of_channels, default=float("nan")), "manifest": json.dumps(manifest, sort_keys=True)}


def _shadow(groom, light=(0, 1, 0), method="deep_opacity", set=None, alpha=0.4, points=None, truth_rays=0, folder="."):
    """Transmittance of a light to points of a groom by a method: `transmittance`, its mean, and against `truth_rays` rays its error."""
    hair = _groom_of(groom, folder)
    found = _shadows.transmittance(hair, light, points, method, alpha=alpha, details=True, **(set or {}))
    values = found["values"]
    result = {"transmittance": values, "mean": float(values.mean(dtype=numpy.float64)) if values.size else float("nan"), "bytes": int(found["bytes"]),
              "run_build_ms": found["build_ms"], "run_lookup_ms": found["lookup_ms"]}
    if truth_rays:
        difference = values - _shadows.truth(hair, light, points, rays=truth_rays, alpha=alpha)[0]
        result["rms_error"] = float(numpy.sqrt(numpy.mean(difference.astype(numpy.float64) ** 2)))
        result["max_error"] = float(numpy.abs(difference).max())
    return result


def _motion(groom, solver="exact", set=None, effects=("gravity",), frames=30, frames_per_second=30.0, head=None, folder="."):
    """Frames of a groom in motion: `positions` at the end, the largest stretch on the way, how often a guard fired. head: (4, 4) or (frames, 4, 4)."""
    simulation = _simulation.simulate(_groom_of(groom, folder), solver, effects, frames_per_second=frames_per_second, **(set or {}))
    places = None if head is None else numpy.broadcast_to(numpy.asarray(head, float), (frames, 4, 4))
    stretch, fired = 0.0, 0
    for frame in range(frames):
        state = simulation.step(head=None if places is None else places[frame])
        stretch, fired = max(stretch, float(simulation.stretch().max())), fired + state.guards_fired
    return {"positions": numpy.array(state.positions), "largest_stretch": stretch, "guards_fired": fired}


def _frame(scene, frame=0, method=None, size=None, layers=False, samples=None, device="", folder="."):
    """A picture of a scene: `picture` (height, width, 4) linear, its mean, and with layers each as `layer_NAME`."""
    if not isinstance(scene, dict):
        text, folder = document(scene, folder)
        scene = json.loads(text)
    if "file" in scene:  # a scene file with changes
        text, folder = document(os.path.join(folder, scene["file"]))
        scene = {**json.loads(text), **{name: value for name, value in scene.items() if name != "file"}}
    renderer = _rendering.Renderer(scene, method, size=size, layers=layers, samples=samples, device=device, folder=folder)
    picture = renderer.frame(frame)
    mean = picture[..., :3].mean(axis=(0, 1), dtype=numpy.float64)
    return {"picture": picture, **dict(zip(("mean_r", "mean_g", "mean_b"), mean.tolist())), "coverage": float(picture[..., 3].mean(dtype=numpy.float64)),
            **{f"layer_{name}": layer for name, layer in renderer.layers.items()}, "device": renderer.device}


def _check(model, set=None, preset=None, precision="f64", quick=True):
    """The checks of a model: whether it is sound, and the likely cause where it is not."""
    report = _models.check_model(model, set=set, preset=preset, precision=precision, quick=quick)
    return {"sound": bool(report["sound"]), "cause": report.get("cause") or "",
            **{f"verdict_{check['check']}": check["verdict"] for check in report["checks"]}}


_TASKS = {}
for _name, _function, _device in (("eval", _eval, False), ("bake", _bake, False), ("shadow", _shadow, False), ("motion", _motion, False),
                                  ("frame", _frame, True), ("check", _check, False)):
    _TASKS[_name] = None
    _TASKS[_name] = Task(_name, _function, needs_device=_device)


def tasks() -> dict:
    """The tasks of sweeps by name; a plan may also name a function of your own."""
    return dict(_TASKS)


def find_task(task):
    """By name, as "package.module:function", or the function itself. Error: usage, listing them."""
    if callable(task):
        return Task(f"{task.__module__}:{task.__qualname__}", task)
    if task in _TASKS:
        return _TASKS[task]
    module, colon, name = str(task).partition(":")
    if not colon:
        raise Error(f"task '{task}' is not one of {', '.join(_TASKS)}", "usage", "package.module:function, for one of your own")
    try:
        return Task(task, getattr(importlib.import_module(module), name))
    except (ImportError, AttributeError) as error:
        raise Error(f"task '{task}': {error}", "usage") from None
