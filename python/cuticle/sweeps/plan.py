"""What a sweep computes: a task, what all items share, and what varies."""
import difflib
import functools
import hashlib
import itertools
import json
import math
import os
import pathlib

import numpy

from .. import _cuticle
from .._errors import Error
from .._inputs import plain
from .tasks import find_task

SCHEMA_VERSION = 1
_KEYS = {"schema_version", "name", "task", "fixed", "vary"}
_RANGES = ({"from", "to", "count"}, {"from", "to", "count", "spacing"}, {"first", "last"}, {"first", "last", "step"},
           {"from", "to", "count", "seed"})


def _refuse_unknown(given, known, where):
    for name in given:
        if name not in known:
            near = difflib.get_close_matches(str(name), known, 1, 0)
            raise Error(f"{where}: '{name}' is not one of {', '.join(sorted(known))}", "bad_input", near[0] if near else "")


def _numbers(name, given):
    """The values of a range: {"from", "to", "count"}, with "spacing": "log" or a "seed" (then drawn evenly); or {"first", "last"}."""
    if set(given) not in _RANGES:
        raise Error(f"vary.{name}: {given!r:.80} is no range", "bad_input", '{"from": 0, "to": 1, "count": 5} or {"first": 0, "last": 47}')
    if "first" in given:
        step = given.get("step", 1)
        return list(range(given["first"], given["last"] + (1 if step > 0 else -1), step))
    low, high, count = float(given["from"]), float(given["to"]), int(given["count"])
    if count < 1 or not (math.isfinite(low) and math.isfinite(high)):
        raise Error(f"vary.{name}: {given!r:.80}: a count above 0 and finite ends are needed", "bad_input")
    if "seed" in given:
        return numpy.random.default_rng(given["seed"]).uniform(low, high, count).tolist()
    if given.get("spacing", "linear") == "linear":
        return numpy.linspace(low, high, count).tolist()
    if given["spacing"] != "log" or low <= 0 or high <= 0:
        raise Error(f"vary.{name}.spacing: {given['spacing']!r:.40}, from {low} to {high}: 'linear', or 'log' between numbers above 0", "bad_input")
    return numpy.geomspace(low, high, count).tolist()


def _values(name, given):
    """A list as it stands, or the numbers of a range; "from:to:count" is a range as on the command line."""
    if isinstance(given, str):
        parts = given.split(":")
        try:
            given = {"from": float(parts[0]), "to": float(parts[1]), "count": int(parts[2])} if len(parts) == 3 else {"first": int(parts[0]), "last": int(parts[1])}
        except (ValueError, IndexError):
            raise Error(f"vary.{name}: '{given}' is no list of values and no range", "bad_input", '"from:to:count", "first:last" or a list') from None
    if isinstance(given, dict):
        given = _numbers(name, given)
    given = list(given)
    if not given:
        raise Error(f"vary.{name}: no values", "bad_input")
    return given


class _Axis:
    """One thing that varies: the names that change together, and their values."""

    def __init__(self, key, given):
        self.names = [name.strip() for name in key.split(",")]
        self.values = _values(key, given)
        for value in self.values if len(self.names) > 1 else ():
            if len(value) != len(self.names):
                raise Error(f"vary.{key}: {value!r:.60} is not one value for each of {len(self.names)} names", "bad_input")

    def changes(self, place):
        value = self.values[place]
        return zip(self.names, value if len(self.names) > 1 else [value])

    def by_name(self):
        """Arrays of objects: all values of each name."""
        columns = {}
        for k, name in enumerate(self.names):
            columns[name] = numpy.empty(len(self.values), object)
            columns[name][:] = [value[k] for value in self.values] if len(self.names) > 1 else self.values
        return columns


def _put(parameters, dotted, value):
    """Sets a parameter by its dotted name, in copies of the dictionaries on the way."""
    *folders, last = dotted.split(".")
    for folder in folders:
        inner = parameters.get(folder) or {}
        if not isinstance(inner, dict):
            raise Error(f"{dotted}: '{folder}' is {inner!r:.60}, and no dictionary", "bad_input")
        parameters[folder] = dict(inner)
        parameters = parameters[folder]
    parameters[last] = value


def _file_digest(path):
    digest = hashlib.sha256()
    with open(path, "rb") as file:
        while block := file.read(1 << 20):
            digest.update(block)
    return {"file": digest.hexdigest()}


@functools.cache
def toolkit() -> str:
    """SHA-256 of the compiled half and of the package's own text: another build may give other results under the same version."""
    package = pathlib.Path(__file__).parents[1]
    digests = [_file_digest(path)["file"] for path in [_cuticle.__file__, *sorted(package.glob("*.py")), *sorted(package.glob("sweeps/*.py"))]]
    return _hash([_cuticle.version(), digests])


def _contents(value, folder, known):
    """What a value stands for: arrays, grooms and files by what they hold, so that a name or a place does not matter."""
    if isinstance(value, dict):
        return {str(name): _contents(part, folder, known) for name, part in value.items()}
    if isinstance(value, (list, tuple)):
        return [_contents(part, folder, known) for part in value]
    if isinstance(value, numpy.ndarray):
        return {"array": hashlib.sha256(numpy.ascontiguousarray(value).tobytes()).hexdigest(), "shape": value.shape, "type": value.dtype.str}
    if isinstance(value, _cuticle.Groom):
        return {"groom": [_contents(array, folder, known) for array in (value.positions, value.offsets, value.radii)]}
    if isinstance(value, (str, os.PathLike)):
        return _file_contents(os.fspath(value), folder, known)
    return value


def _file_contents(text, folder, known):
    """A text that names a file stands for the file, and a JSON file for the files that it names as well."""
    if len(text) > 4096 or "." not in text and "/" not in text:
        return text
    path = pathlib.Path(folder, text)
    if str(path) not in known:
        known[str(path)] = text
        try:
            if path.is_file():
                inside = json.loads(path.read_text(encoding="utf-8")) if path.suffix in (".json", ".gltf") else None
                known[str(path)] = [_file_digest(path), _contents(inside, path.parent, known)]
        except (OSError, ValueError):
            pass
    return known[str(path)]


def _hash(value):
    return hashlib.sha256(json.dumps(value, sort_keys=True, separators=(",", ":"), default=plain).encode()).hexdigest()


class Plan:
    """A task, what all items share (`fixed`), and what varies (`vary`): every combination of the values is an item.

    description: a dictionary, or the path of a JSON file, with `task` (a name of `cuticle.sweeps.tasks()`, "package.module:function",
    or from Python a function), `fixed` and `vary`. Names with dots reach inside: "set.beta_m", "scene.camera.position". A key
    of `vary` may be several names with commas, whose values then come as lists and change together; `vary` may be a list of
    such dictionaries, one after the other. Values: a list, "from:to:count", "first:last", or {"from", "to", "count"} with
    "spacing": "log" or with a "seed" (numbers drawn evenly). folder: of relative paths; of a file, its own.
    """

    def __init__(self, description, folder=None):
        if not isinstance(description, dict):
            folder = folder or pathlib.Path(description).parent
            description = _read(pathlib.Path(description))
        _refuse_unknown(description, _KEYS, "sweep")
        if description.get("schema_version", SCHEMA_VERSION) != SCHEMA_VERSION:
            raise Error(f"sweep.schema_version: {description['schema_version']!r:.20} is not {SCHEMA_VERSION}", "bad_input")
        if "task" not in description:
            raise Error("sweep: no task", "bad_input", '"task": "eval"')
        self.folder = os.path.abspath(folder or os.getcwd())
        self.name = str(description.get("name", "sweep"))
        self.task = find_task(description["task"])
        self.fixed = _dictionary("fixed", description.get("fixed", {}))
        vary = description.get("vary", {})
        blocks = [_dictionary("vary", block) for block in (vary if isinstance(vary, list) else [vary])]
        self._blocks = [[_Axis(name, given) for name, given in block.items()] for block in blocks]
        self._counts = [math.prod(len(axis.values) for axis in block) for block in self._blocks]
        self._starts = [0, *itertools.accumulate(self._counts)]
        self._known_files = {}
        self._fixed_contents = _contents(self.fixed, self.folder, self._known_files)
        self._check_names()
        self.digest = self._digest()

    @property
    def varied(self) -> list:
        """The dotted names that vary."""
        return list(dict.fromkeys(name for block in self._blocks for axis in block for name in axis.names))

    def __len__(self):
        return self._starts[-1]

    def __repr__(self):
        return f"Plan '{self.name}': {len(self)} items of {self.task.name} over {', '.join(self.varied) or 'nothing'}"

    def _check_names(self):
        """Each block of `vary` with what is fixed gives what the task takes."""
        for block in self._blocks:
            self.task.check_names([name.split(".")[0] for name in [*self.fixed, *(name for axis in block for name in axis.names)]])

    def _places(self, indices):
        """For each block of `vary`: which of the indices are in it, and the place on each axis. The last axis runs fastest."""
        for block, axes in enumerate(self._blocks):
            inside = (indices >= self._starts[block]) & (indices < self._starts[block + 1])
            rest, places = indices[inside] - self._starts[block], []
            for axis in reversed(axes):
                rest, place = numpy.divmod(rest, len(axis.values))
                places.append(place)
            yield inside, list(zip(axes, reversed(places)))

    def columns(self, indices) -> dict:
        """What varies at items, lists by dotted name; None where a name does not vary there."""
        columns = {name: numpy.full(len(indices), None, object) for name in self.varied}
        for inside, places in self._places(numpy.asarray(indices, numpy.int64)):
            for axis, place in places:
                for name, values in axis.by_name().items():
                    columns[name][inside] = values[place]
        return {name: values.tolist() for name, values in columns.items()}

    def changes(self, index: int) -> dict:
        """What is particular to an item, by dotted name."""
        if not 0 <= index < len(self):
            raise Error(f"item {index} is outside 0 .. {len(self) - 1}", "usage")
        block = next(b for b in range(len(self._blocks)) if index < self._starts[b + 1])
        rest, changes = index - self._starts[block], {}
        for axis in reversed(self._blocks[block]):
            rest, place = divmod(rest, len(axis.values))
            changes = {**dict(axis.changes(place)), **changes}
        return changes

    def parameters(self, index: int) -> dict:
        """The arguments of an item's task."""
        parameters = dict(self.fixed)
        for name, value in self.changes(index).items():
            _put(parameters, name, value)
        return parameters

    def key(self, index: int) -> str:
        """What an item's result is stored under: SHA-256 of its task, the toolkit (`toolkit()`) and all that goes in, files by what they hold."""
        contents = dict(self._fixed_contents)
        for name, value in self.changes(index).items():
            _put(contents, name, _contents(value, self.folder, self._known_files))
        return _hash({"task": self.task.identity, "toolkit": toolkit(), "parameters": contents})[:32]

    def _digest(self):
        """Of everything that the plan's items are made of."""
        axes = [[(axis.names, axis.values) for axis in block] for block in self._blocks]
        return _hash({"task": self.task.identity, "toolkit": toolkit(), "fixed": self._fixed_contents,
                      "vary": _contents(axes, self.folder, self._known_files)})[:16]

    def describe(self) -> dict:
        """The plan as a store keeps it, for people: values that JSON has no form for are described."""
        axes = [{",".join(axis.names): axis.values for axis in block} for block in self._blocks]
        text = json.dumps({"schema_version": SCHEMA_VERSION, "name": self.name, "task": self.task.name, "fixed": self.fixed, "vary": axes},
                          default=lambda value: repr(value)[:80])
        return json.loads(text)


def _dictionary(name, given):
    if not isinstance(given, dict):
        raise Error(f"sweep.{name}: {given!r:.60} is no dictionary", "bad_input")
    return dict(given)


def _read(path):
    try:
        description = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError, RecursionError) as error:
        raise Error(f"{path}: {error}", "bad_input") from None
    return _dictionary(path.name, description)
