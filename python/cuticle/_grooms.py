"""Hair as arrays: made, read, written, grown, shaped, bound to a mesh, checked."""
import copyreg
import json
import typing

import numpy

from . import _cuticle
from ._cuticle import Groom
from ._errors import Error
from ._inputs import as_array, blocks, document, floats, indices, path, settings, single
from ._progress import ticking

DEFAULT_RADIUS = 35e-6


class Mesh(typing.NamedTuple):
    """positions: float32 (vertices, 3), metres; triangles: uint32 (triangles, 3); normals: float32 (vertices, 3)."""

    positions: numpy.ndarray
    triangles: numpy.ndarray
    normals: numpy.ndarray


class Head(typing.NamedTuple):
    """The procedural head: its mesh, the part that carries hair, and spheres (n, 4) of x, y, z, radius, metres."""

    mesh: Mesh
    scalp: Mesh
    spheres: numpy.ndarray


class Binding(typing.NamedTuple):
    """Roots on a mesh: triangle uint32 (strands); weights float32 (strands, 3) of its corners; and how well they fit."""

    triangle: numpy.ndarray
    weights: numpy.ndarray
    largest_distance: float
    far_strands: int
    empty_strands: int
    degenerate_triangles: int


class SceneHair(typing.NamedTuple):
    """A scene's hair at rest: simulated hairs, drawn strands, the head's mesh, collider spheres (n, 4)."""

    control: Groom
    drawn: Groom
    head: Mesh
    spheres: numpy.ndarray


def make_groom(points, counts=None, radii=DEFAULT_RADIUS, root_uv=None, strand_attributes=None, vertex_attributes=None) -> Groom:
    """A groom from arrays, in metres.

    points: (vertices, 3), strand after strand, roots first; or (strands, vertices, 3), then without counts. counts: (strands),
    vertices of each. radii: one number, or (vertices). root_uv: (strands, 2). Attributes: dictionaries of arrays with a row
    for each strand or vertex. The groom is a copy; Groom.positions and its others are views of it. Takes arrays of PyTorch
    and JAX as well (DLPack).
    """
    points = as_array(points)
    if counts is None:
        if points.ndim != 3:
            raise Error(f"points: an array of shape {points.shape} needs counts; without them it is (strands, vertices, 3)", "bad_input")
        counts = numpy.full(points.shape[0], points.shape[1])
        points = points.reshape(-1, 3)
    points = floats("points", points, 3)
    radii = numpy.full(len(points), radii, numpy.float32) if numpy.ndim(radii) == 0 else floats("radii", radii)
    named = [(name, domain, single(values))
             for domain, given in (("strand", strand_attributes), ("vertex", vertex_attributes)) for name, values in (given or {}).items()]
    return _cuticle.groom_from_arrays(points, indices("counts", counts), radii, None if root_uv is None else floats("root_uv", root_uv, 2), named)


def load_groom(path_of_file, metres_per_unit=0.0, radius=0.0, repair=False) -> Groom:
    """Reads a groom file by its ending (`cuticle.formats()`). metres_per_unit 0: as it states, or guessed (see Groom.notes); radius 0:
    the file's own, or 35e-6 m; repair: damage is mended, not refused."""
    return _cuticle.load_groom(path(path_of_file), metres_per_unit, radius, repair)


def write(groom: Groom, path_of_file, metres_per_unit=1.0) -> list:
    """Writes a groom by the file's ending (those of `formats`, or .glb); gives what the format cannot hold, one sentence each."""
    return groom._write(path(path_of_file), metres_per_unit)


def grow(specification=None, share=None, control=False, *, progress=None) -> Groom:
    """Grows hair on the procedural head from a grooming specification: a dictionary as docs/grooming.schema.json has it, or the path
    of a JSON file. share: 0 .. 1, of the strands; control: the control hairs instead of the strands between them."""
    text, _ = document({} if specification is None else specification)
    with ticking(progress, "grow"):
        drawn, guides = _cuticle.grow(text, -1.0 if share is None else float(share))
    return guides if control else drawn


def hair_of(scene, folder=None, *, progress=None) -> SceneHair:
    """The hair of a scene (dictionary or path) before its first frame."""
    with ticking(progress, "hair_of"):
        control, drawn, head, spheres = _cuticle.hair_of(*document(scene, folder))
    return SceneHair(control, drawn, Mesh(*head), spheres)


def make_head(scalp_vertices=300) -> Head:
    """The procedural head, about 0.23 m tall, facing +z, its neck at the origin."""
    mesh, scalp, spheres = _cuticle.head(int(scalp_vertices))
    return Head(Mesh(*mesh), Mesh(*scalp), spheres)


def shape(groom: Groom, effects, root_normals=None, seed=1) -> Groom:
    """A groom shaped by effects (`cuticle.shapings()`): {"curl": {...}} or a list of names. root_normals: (strands, 3), +y unless given."""
    normals = None if root_normals is None else floats("root_normals", root_normals, 3)
    return _cuticle.shape_groom(groom, blocks(effects), normals, int(seed))


def _mesh(mesh):
    return floats("positions", mesh[0], 3), indices("triangles", mesh[1], 3)


def bind(groom: Groom, mesh, far=0.005) -> Binding:
    """Binds roots to the nearest points of a mesh: (positions (n, 3), triangles (m, 3)) or a Mesh. Roots farther away than `far` metres
    are counted, and bound all the same."""
    return Binding(*_cuticle.bind_groom(groom, *_mesh(mesh), float(far)))


def carry(groom: Groom, mesh, binding: Binding, moved) -> Groom:
    """The groom where the mesh that it is bound to has moved: rigid in the frames of its roots. moved: (vertices, 3)."""
    return _cuticle.carry_groom(groom, _mesh(mesh), (binding.triangle, binding.weights), floats("moved", moved, 3))


class Cards:
    """Hair cards in the place of strands: textured strips of quads.

    mesh: a Mesh, metres, triangles from inside to outside; uv: float32 (vertices, 2) in the atlas; occlusion: float32 (vertices); textures: float32
    (height, width) by name ("base", "shift", "mask", "alpha"), row 0 at the roots; report: sizes, kinds, and the error of cover.
    """

    def __init__(self, made):
        self._made = made
        self.mesh, self.uv, self.occlusion = Mesh(*made._mesh()), made._uv(), made._occlusion()
        self.textures = {name: made._atlas()[..., k] for k, name in enumerate(made._channels())}
        self.report = json.loads(made._report())

    def write(self, folder):
        """cards.obj, cards.mtl, a PNG for each texture, and cards.json."""
        self._made._write(path(folder))


def make_cards(groom: Groom, set=None, head=None, *, progress=None) -> Cards:
    """Hair cards of a groom. set: parameters of `cuticle cards --set`, as {"cards": 300, "layers": 2}; head: the mesh that the hair grows on
    (positions, triangles), which shades them."""
    with ticking(progress, "make_cards"):
        return Cards(_cuticle.make_cards(groom, settings(set), *(_mesh(head) if head is not None else (None, None))))


def check_groom(groom: Groom) -> list:
    """What a groom should hold before it is used: dictionaries with check, passed, measured, mistake and remedy."""
    return [dict(zip(("check", "passed", "measured", "mistake", "remedy"), verdict)) for verdict in groom._check()]


def _pickled(groom):
    strand, vertex = {}, {}
    for name, values in groom.attributes.items():
        (strand if len(values) == len(groom) else vertex)[name] = numpy.array(values)
    root_uv = numpy.array(groom.root_uv) if len(groom.root_uv) else None
    return make_groom, (numpy.array(groom.positions), numpy.diff(groom.offsets), numpy.array(groom.radii), root_uv, strand, vertex)


copyreg.pickle(Groom, _pickled)  # for processes of a cluster
