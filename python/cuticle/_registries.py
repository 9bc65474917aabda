"""What the program offers, by name: lists of dictionaries with name, summary, source, parameters (unit, range, default)."""
import json

from . import _cuticle


def _read(name):
    return json.loads(_cuticle.registry_json(name))


def methods() -> list:
    """The shadow methods of `cuticle.shadows`."""
    return _read("methods")


def solvers() -> list:
    """The strand solvers of `cuticle.simulate`."""
    return _read("solvers")


def effects() -> list:
    """The effects that act in a simulation."""
    return _read("effects")


def passes() -> list:
    """The render passes; a scene gives their parameters under "passes"."""
    return _read("passes")


def layouts() -> list:
    """The layouts of lookup tables of `cuticle.bake`."""
    return _read("layouts")


def shapings() -> list:
    """The effects of `cuticle.shape`."""
    return _read("shapings")


def formats() -> list:
    """Groom files: name, summary, extensions, read_only (endings that are not written), writes."""
    return _read("formats")


def render_methods() -> list:
    """Names of the ways in which `cuticle.render` draws strands."""
    return _read("render_methods")
