"""What an Alembic file holds, as arrays: its curves with the matrix above them, and the properties of an object."""
import dataclasses

import numpy
from alembic3d import Abc, AbcGeom

from . import names

OBJECTS, DEPTH = 4_000_000, 200  # a damaged file may hold itself


@dataclasses.dataclass
class Property:
    kind: str      # "int32", "float32", ..
    values: numpy.ndarray  # elements x parts
    scope: str     # con, uni, vtx, "" where none is stated
    indexed: bool = False


@dataclasses.dataclass
class Curves:
    name: str
    schema: object
    stored: dict           # P, nVertices, width, uv, ..: name -> Property
    matrix: numpy.ndarray  # 4 x 4, rows as Alembic has them: a point is a row from the left
    moves: bool            # a transformation above has more than one sample

    def counts_and_places(self):
        if not {"P", "nVertices"} <= set(self.stored):
            raise ValueError(f"{self.name}: curves without points")
        counts, places = self.stored["nVertices"].values.ravel().astype(numpy.int64), self.stored["P"].values.reshape(-1, 3).astype(float)
        if (counts < 0).any() or counts.sum() != len(places):
            raise ValueError(f"{self.name}: counts of points add up to {counts.sum()}, {len(places)} points are stored")
        return counts, places


def opened(path):
    archive = Abc.IArchive(path)
    if not archive.valid():
        raise ValueError("it is no Alembic file")
    return archive


def matrix_of(schema):
    found = schema.getValue().getMatrix()
    return numpy.array([[found[row][column] for column in range(4)] for row in range(4)])


def curves_of(archive):
    """Every curves object, depth first."""
    left, waiting = OBJECTS, [(archive.getTop(), numpy.eye(4), False, 0)]
    found = []
    while waiting:
        parent, matrix, moves, depth = waiting.pop()
        children = []
        for k in range(parent.getNumChildren()):
            left -= 1
            if left < 0 or depth > DEPTH:
                raise ValueError(f"objects nest deeper than {DEPTH} or are more than {OBJECTS}")
            header = parent.getChildHeader(k)
            if AbcGeom.ICurves.matches(header):
                made = AbcGeom.ICurves(parent, header.getName())
                stored = properties(Abc.ICompoundProperty(made.getProperties(), ".geom"))
                found.append(Curves(header.getFullName(), made.getSchema(), stored, matrix, moves))
            elif AbcGeom.IXform.matches(header):
                schema = AbcGeom.IXform(parent, header.getName()).getSchema()
                own = matrix_of(schema)
                children.append((parent.getChild(k), own @ matrix if schema.getInheritsXforms() else own, moves or schema.getNumSamples() > 1, depth + 1))
            else:
                children.append((parent.getChild(k), matrix, moves, depth + 1))
        waiting.extend(reversed(children))
    return found


def array_of(parent, name):
    held = Abc.IArrayProperty(parent, name)
    if held.getNumSamples() == 0:
        return numpy.zeros(0)
    value = held.getValue()
    return numpy.array(value)


def property_of(parent, header):
    """A geometry parameter or a scalar; None: text, or nothing that is stored."""
    scope, name = header.getMetaData().get("geoScope"), header.getName()
    if header.isCompound():  # an indexed parameter
        compound = Abc.ICompoundProperty(parent, name)
        inner = compound.getPropertyHeader(".vals")
        values, picks = array_of(compound, ".vals"), array_of(compound, ".indices").astype(numpy.int64)
        if len(picks) and (picks.min() < 0 or picks.max() >= len(values)):
            raise ValueError(f"{name}: an index lies outside its {len(values)} values")
        return numbers(inner, values[picks], scope, True)
    if header.isScalar():
        return numbers(header, numpy.array([Abc.IScalarProperty(parent, name).getValue()]), scope)
    return numbers(header, array_of(parent, name), scope)


def numbers(header, values, scope, indexed=False):
    kind = str(header.getDataType().getPod()).rsplit(".", 1)[-1].removeprefix("k").replace("POD", "").replace("_t", "").lower()
    if values.dtype.kind not in "iufb":
        return None
    extent = int(header.getMetaData().get("arrayExtent") or 1) * header.getDataType().getExtent()
    if values.size % max(extent, 1):
        raise ValueError(f"{header.getName()}: {values.size} numbers do not divide into {extent} a piece")
    return Property(kind, values.reshape(-1, max(extent, 1)), scope, indexed)


def properties(compound):
    """Name -> Property of a compound; empty where there is none."""
    if not compound or not compound.valid():
        return {}
    found = {}
    for k in range(compound.getNumProperties()):
        header = compound.getPropertyHeader(k)
        is_curves_own = header.getName().startswith(".") or (header.isCompound() and not header.getMetaData().get("podName"))
        if not is_curves_own and (value := property_of(compound, header)) is not None:
            found[header.getName()] = value
    return found


def unit_of(opened):
    """Metres of a unit, as files of ours state it; 0: not stated."""
    found = properties(opened.getTop().getProperties())
    return float(found[names.UNIT].values[0, 0]) if names.UNIT in found else 0.0
