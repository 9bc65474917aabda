"""Scenes as plans and pictures."""
import json
import os
import tempfile
import typing

import numpy

from . import _cuticle
from ._cuticle import Groom
from ._errors import Error
from ._inputs import document, single
from ._progress import progress_of


class Pass(typing.NamedTuple):
    """A pass of a frame, and why it runs."""

    name: str
    reason: str
    dispatches: int
    draws: int


class Plan:
    """The passes that a scene demands. passes: in the order in which they run; left_out: names with reasons; facts: of the scene."""

    def __init__(self, text: str):
        self.json = json.loads(text)
        self.passes = [Pass(p["name"], p["reason"], p["dispatches"], p["draws"]) for p in self.json["passes"]]
        self.left_out = {p["name"]: p["reason"] for p in self.json["left_out"]}
        self.facts = self.json["facts"]

    def why(self, name: str) -> str:
        """Why a pass runs, or why it does not."""
        for planned in self.passes:
            if planned.name == name:
                return planned.reason
        if name in self.left_out:
            return "left out: " + self.left_out[name]
        raise Error(f"'{name}' is no pass (try: cuticle.passes())")

    def __repr__(self):
        return f"Plan of {len(self.passes)} passes: {', '.join(planned.name for planned in self.passes)}"


class _Written:
    """A scene whose groom is an object, with a file of it while it is read."""

    def __init__(self, scene, folder, changes):
        self._scene, self._folder, self._changes = scene, folder, changes

    def __enter__(self):
        scene, folder, self._temporary = self._scene, self._folder, None
        if not isinstance(scene, dict):
            text, folder = document(scene, folder)
            scene = json.loads(text)
        scene = dict(scene)
        if isinstance(scene.get("groom"), Groom):
            self._temporary = tempfile.TemporaryDirectory()
            file = os.path.join(self._temporary.name, "groom.hair")
            scene["groom"]._write(file, 1.0)
            scene["groom"] = {"file": file, "metres_per_unit": 1}
        for change in self._changes:
            change(scene)
        return document(scene, folder)

    def __exit__(self, *_):
        if self._temporary:
            self._temporary.cleanup()


def _within(key, **values):
    given = {name: value for name, value in values.items() if value is not None}

    def change(scene):
        if given:
            scene[key] = {**scene.get(key, {}), **given}

    return change


def _paths(samples):
    def change(scene):
        if samples is not None:
            passes = dict(scene.get("passes", {}))
            passes["reference"] = {**passes.get("reference", {}), "samples": samples}
            scene["passes"] = passes

    return change


def _layers(pixels, names):
    """Channels by layer: "velocity.X" and "velocity.Y" are the two of "velocity"."""
    groups = {}
    for index, name in enumerate(names):
        layer, dot, _ = name.rpartition(".")
        groups.setdefault(layer if dot else ("color" if name in "RGBA" else name), []).append(index)
    return {name: pixels[..., places[0]] if len(places) == 1 else pixels[..., places] for name, places in groups.items()}


def _seen(places, shares, width):
    """Columns of equal length: row and column of the pixel, the strand (from 0; -1: no hair), its distance, its light and its share."""
    pixels, objects = places[:, 0].astype(numpy.int64), places[:, 1].astype(numpy.int64)
    return {"row": pixels // width, "column": pixels % width, "strand": objects - 1, "depth": shares[:, 0], "light": shares[:, 1:4], "share": shares[:, 4]}


class Renderer:
    """A scene that is ready to be drawn, frame by frame; see `render`. seen: what each pixel sees of each strand, as arrays in `seen`
    after a frame: row, column, strand (from 0; -1: no hair), depth (metres), light (times the share) and share; they add up to the picture."""

    def __init__(self, scene, method=None, *, size=None, layers=False, seen=False, samples=None, device="", folder=None, progress=None):
        self._progress = progress_of(progress)
        changes = [_within("render", method=method), _within("camera", resolution_px=None if size is None else list(size)),
                   _within("outputs", aovs=True if layers else None, deep=True if seen else None), _paths(samples)]
        with _Written(scene, folder, changes) as (text, of_paths):
            self._frames = _cuticle.open_frames(text, of_paths, device, self._progress)
            self._folder = of_paths
        self.plan = Plan(self._frames.plan())
        self.device = self._frames.device()
        self.layers = {}
        self.seen = None
        self.notes = []

    def frame(self, frame: int = 0) -> numpy.ndarray:
        """Frame `frame`, float32 (height, width, 4): linear red, green, blue and coverage, the top row first. Sets `layers`, `seen` and `notes`."""
        (pixels, _), (layers, names), (places, shares), self.notes = self._frames.run(int(frame), self._progress)
        self.layers = _layers(layers, names) if layers.size else {}
        self.seen = _seen(places, shares, pixels.shape[1])
        return pixels

    def change(self, **blocks):
        """Gives the scene other blocks of a scene file, each whole and in place of its own: camera (whose size stays), material, passes,
        render, shadow, simulation. Only what they touch is made anew: other parameters of the material's model take milliseconds. The
        next `frame` is that of the changed scene; where blocks are refused, the scene stays as it was."""
        known = _cuticle.changed_blocks()
        for block in blocks:
            if block not in known:
                raise Error(f"'{block}' cannot change in a Renderer (try: {', '.join(known)}; else open another)", "usage")
        if "camera" in blocks:
            blocks["camera"] = {"resolution_px": list(self._frames.resolution()), **blocks["camera"]}
        text, folder = document(blocks, self._folder)
        self._frames.change(text, folder, list(blocks), self._progress)
        self.plan = Plan(self._frames.plan())

    def strands(self) -> Groom:
        """The strands drawn in the frame last run."""
        return self._frames.strands()


def render(scene, method=None, frame: int = 0, *, size=None, layers=False, samples=None, device="", folder=None, progress=None):
    """A picture of a scene: float32 (height, width, 4), linear radiance and coverage, the top row first.

    scene: a dictionary as docs/scene.schema.json has it, checked as a file is; its "groom" may be a Groom; or a file's path. method:
    one of `cuticle.render_methods()` in place of the scene's. "reference" traces paths on the CPU (Embree), the others
    draw by Vulkan, in software where there is no GPU: device "" chooses, "cpu" is software, a name or number is that device.
    size: (width, height) in pixels. layers: True gives (picture, dictionary of layers by name). samples: paths of a pixel, of
    "reference". folder: of relative paths. progress: True (tqdm) or a function of task, done, total.
    """
    renderer = Renderer(scene, method, size=size, layers=layers, samples=samples, device=device, folder=folder, progress=progress)
    picture = renderer.frame(frame)
    return (picture, renderer.layers) if layers else picture


def plan(scene, method=None, folder=None) -> Plan:
    """The passes that a scene (dictionary or path) demands, each with its reason."""
    with _Written(scene, folder, [_within("render", method=method)]) as (text, of_paths):
        return Plan(_cuticle.plan_json(text, of_paths))


def tone_map(picture, exposure_stops: float = 0.0) -> numpy.ndarray:
    """Linear radiance (height, width, 3 or 4) as sRGB values 0 .. 1 to show."""
    return _cuticle.tone_map(single(picture), float(exposure_stops))


def scene_schema() -> dict:
    """The JSON Schema of scenes."""
    return json.loads(_cuticle.scene_schema())
