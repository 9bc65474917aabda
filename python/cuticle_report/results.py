"""What the study engine wrote: result.json, times.json and conclusions.json of one study (study/README.md)."""
import dataclasses
import math
import pathlib

from . import ReportError, data

KEYS = {"result.json": ("name", "title", "question", "command", "cost_label", "groups", "plots", "tables", "pictures", "notes"),
        "times.json": ("machine", "clock", "kernel", "kernel_seconds", "groups"), "conclusions.json": ("groups",)}


@dataclasses.dataclass
class Point:
    """A setting of a method: errors by metric, seconds and their interval (None: not timed)."""
    name: str
    method: str
    knobs: dict
    errors: dict
    bytes: float
    seconds: dict = None
    samples: int = 0

    def error(self, metric):
        return self.errors[metric]["mean"]


@dataclasses.dataclass
class Group:
    raw: dict
    points: list
    conclusions: dict
    flips: dict = dataclasses.field(default_factory=dict)  # of a ladder: mean FLIP by rung

    @property
    def metric(self):
        return self.raw["metrics"][0]["name"] if self.raw["metrics"] else None

    @property
    def front(self):
        return {place["point"] for place in self.conclusions["front"] if place["on_front"]}

    def drawable(self):
        """Points that an error-against-time plot on logarithmic axes has a place for."""
        return [point for point in self.points if point.seconds and self.metric and (point.error(self.metric)["value"] or 0) > 0]


@dataclasses.dataclass
class Study:
    folder: pathlib.Path
    raw: dict
    times: dict
    groups: list

    @property
    def name(self):
        return self.raw["name"]


def read(folder, name):
    raw = data.read_json(folder / name)
    for key in KEYS[name]:
        if key not in raw:
            raise ReportError(f"{folder / name}: key '{key}' is missing")
    return raw


def point_of(raw, times):
    time = times.get(raw["point"])
    return Point(raw["point"], raw["method"], raw["knobs"], {error["metric"]: error for error in raw["errors"]}, raw["bytes"],
                 time and time["seconds"], time["samples"] if time else 0)


def load(folder):
    """The study in a folder."""
    result, times, conclusions = (read(folder, name) for name in KEYS)
    groups = []
    try:
        for group, timed, concluded in zip(result["groups"], times["groups"], conclusions["groups"], strict=True):
            by_point = {point["point"]: point for point in timed["points"]}
            groups.append(Group(group, [point_of(point, by_point) for point in group["points"]], concluded))
    except (KeyError, TypeError, ValueError) as error:
        raise ReportError(f"{folder / 'result.json'}: not as study/README.md describes: {error}") from error
    return Study(folder, result, times, groups)


def load_all(folder):
    """The studies of a folder: its own, or those in its folders."""
    if (folder / "result.json").is_file():
        return [load(folder)]
    return [load(path.parent) for path in sorted(folder.glob("*/result.json"))]


def unit_of(seconds):
    """Factor and name of the unit that makes these seconds readable."""
    largest = max(seconds, default=1) or 1
    for factor, name in ((1e9, "ns"), (1e6, "µs"), (1e3, "ms")):
        if largest * factor < 2000:
            return factor, name
    return 1, "s"


def shown(value, digits=3):
    """A number as a person writes it: so many digits that count, powers of ten below 0.001 only."""
    if value is None or (isinstance(value, float) and not math.isfinite(value)):
        return ""
    if value == 0 or abs(value) < 1e-3:
        return f"{value:.{digits}g}"
    places = digits - 1 - math.floor(math.log10(abs(value)))
    return f"{round(value, places):,.{max(0, places)}f}"
