"""Strand solvers step by step."""
from typing import NamedTuple

import numpy

from . import _cuticle
from ._cuticle import Groom, State
from ._errors import Error
from ._inputs import blocks, doubles, floats, indices, numbers, to_json
from ._progress import progress_of

__all__ = ["Rest", "Simulation", "State", "simulate"]


class Rest(NamedTuple):
    """Hair at rest (`Simulation.at_rest`): the groom, and an array with one entry per strand each."""
    groom: Groom
    residual: numpy.ndarray  # the largest moment that is not balanced, over the strand's weight times its length
    steps: numpy.ndarray  # of Newton's
    depth: numpy.ndarray  # of the deepest place in a collider, metres
    balanced: numpy.ndarray  # whether the residual is below 1e-9
    stable: numpy.ndarray  # whether the energy's second derivatives are positive definite there
    stiffening: numpy.ndarray  # what `sag_free` added so that the groom holds: the factor on EI and GJ
    held: numpy.ndarray  # whether the groom's own pose is stable with it


class Simulation:
    """Hair in motion; see `simulate`. The groom at rest is in the head's space; colliders move with the head."""

    def __init__(self, groom: Groom, solver: str, effects, frames_per_second: float, settings: dict):
        if not 0 < frames_per_second < float("inf"):
            raise Error(f"frames_per_second: {frames_per_second} is not above 0")
        self._collides = "colliders" in effects
        self._simulation = _cuticle.Simulation(groom, solver, to_json(settings), blocks(effects))
        self._duration = 1 / frames_per_second
        self._head = numpy.eye(4)
        self._state = None

    def step(self, count: int = 1, head=None, *, seconds=None, teleport=False, progress=None) -> State:
        """Simulates `count` frames and gives the state at their end.

        head: (4, 4), rest to world at the end of the first of them, rigid; none: where it is. teleport: the hair moves with it
        as it is. seconds: duration of a frame instead of 1 / frames_per_second. Ctrl-C ends it between frames. progress: True
        (tqdm) or a function of task, done, total.
        """
        if head is not None:
            self._head = numbers("head", head).copy()
        self._state = None
        self._simulation.step(self._duration if seconds is None else float(seconds), int(count), self._head, bool(teleport), progress_of(progress))
        return self.state

    @property
    def state(self) -> State:
        """The state now: positions, velocities, tensions; views of memory that later steps leave alone."""
        if self._state is None:
            self._state = self._simulation.state()
        return self._state

    @property
    def time(self) -> float:
        """Seconds simulated."""
        return self._simulation.time()

    @property
    def head(self) -> numpy.ndarray:
        """Where the head is, (4, 4)."""
        return self._head.copy()

    def at_rest(self, *, progress=None) -> Rest:
        """The equilibrium of the hair under gravity and the colliders, by Newton's method on the energy of the solver "rod"; see `Rest`.

        The head stands as in the rest pose; wind, friction and hair beside hair take no part. The simulation itself stays where it is.
        progress: True (tqdm) or a function of task, done, total.
        """
        found = self._simulation.at_rest(progress_of(progress))
        return Rest(**{name: found[name] if name in ("groom", "residual", "depth", "stiffening") else found[name].astype(int if name == "steps" else bool)
                       for name in Rest._fields})

    def groom(self) -> Groom:
        """The hair as it is now."""
        return self._simulation.groom()

    def stretch(self) -> numpy.ndarray:
        """float32 (vertices): length of the segment towards the root over its length at rest."""
        return self._simulation.stretch()

    def curvature(self) -> numpy.ndarray:
        """float32 (vertices), 1/m."""
        return self._simulation.curvature()

    def set_colliders(self, *, spheres=None, capsules=None, meshes=None, moving_spheres=None) -> None:
        """Colliders of the next steps; what is not given stays, an empty list takes them away.

        In the head's rest space: spheres (n, 4) of x, y, z, radius; capsules (n, 7) of two places and a radius; meshes, a list of
        (positions, triangles, spacing of the distance field). In world space: moving_spheres (n, 4), which move evenly to these
        places in the next frame. Metres. The solver "classic" meets spheres alone.
        """
        if not self._collides and any(given is not None for given in (spheres, capsules, meshes, moving_spheres)):
            raise Error("colliders: the simulation has no effect 'colliders' (try: effects=['gravity', 'colliders'])")
        if spheres is not None:
            self._simulation.set_spheres(doubles("spheres", spheres, 4))
        if capsules is not None:
            self._simulation.set_capsules(doubles("capsules", capsules, 7))
        if moving_spheres is not None:
            self._simulation.set_moving(doubles("moving_spheres", moving_spheres, 4))
        if meshes is not None:
            self._simulation.clear_meshes()
            for positions, triangles, spacing in meshes:
                self._simulation.add_mesh(floats("positions", positions, 3), indices("triangles", triangles, 3), float(spacing))

    def set_authored(self, positions=(), weights=()) -> None:
        """Of the effect "control": world places (vertices, 3) at the end of the next steps, and factors 0 .. 1 (vertices) of its weight."""
        self._simulation.set_authored(floats("authored", positions, 3), floats("weights", weights))

    def reset(self) -> None:
        """To rest, at time 0; colliders stay."""
        self._simulation.reset()
        self._head = numpy.eye(4)
        self._state = None


def simulate(groom: Groom, solver: str = "exact", effects=("gravity", "colliders"), *, frames_per_second: float = 30.0, spheres=None, capsules=None,
             meshes=None, **settings) -> Simulation:
    """A simulation of a groom by a registered solver with its parameters by name.

    effects: names (`cuticle.effects()`), or {"gravity": {}, "wind": {"velocity": [3, 0, 0]}}. Each vertex of the groom is
    simulated. The solvers take the groom to hang in gravity at rest, unless sag_free=False. Colliders: see
    Simulation.set_colliders.

        simulation = cuticle.simulate(groom, solver="exact", shape_stiffness=20)
        state = simulation.step(30)
    """
    made = Simulation(groom, solver, effects, frames_per_second, settings)
    made.set_colliders(spheres=spheres, capsules=capsules, meshes=meshes)
    return made
