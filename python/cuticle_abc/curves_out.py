"""The arrays of a groom (.npz, metres) as Alembic curves with Unreal's groom schema."""
import re

import imath
import numpy
from alembic3d import Abc, AbcGeom

from . import names

CONSTANT, UNIFORM, VERTEX = (AbcGeom.GeometryScope.kConstantScope, AbcGeom.GeometryScope.kUniformScope, AbcGeom.GeometryScope.kVertexScope)
LARGEST = float(numpy.finfo(numpy.float32).max)


def floats(values):
    """For Alembic; what the unit makes too large for a float is refused."""
    if values.size and not abs(values).max() <= LARGEST:
        raise ValueError("a number is too large for a float in this unit")
    return numpy.ascontiguousarray(values, numpy.float32)


def add(parent, kind, name, values, scope, extent=1):
    """`kind`: Int32, Float, V2f, V3f."""
    wrap = {"Int32": "Int", "Float": "Float", "V2f": "V2f", "V3f": "V3f"}[kind]
    held = getattr(imath, f"{wrap}ArrayFromBuffer")(numpy.ascontiguousarray(values))  # a sample points into it, and does not keep it
    sample = getattr(AbcGeom, f"O{kind}GeomParamSample")(held, scope)
    getattr(AbcGeom, f"O{kind}GeomParam")(parent, name, False, scope, extent).set(sample)


def add_version(xform, tool):
    """On the topmost node, where the schema wants it: as geometry parameters and as user properties."""
    schema = xform.getSchema()
    parameters, user = schema.getArbGeomParams(), schema.getUserProperties()
    for name, value in zip(("groom_version_major", "groom_version_minor"), names.VERSION):
        one = imath.ShortArray(1)
        one[0] = value
        AbcGeom.OInt16GeomParam(parameters, name, False, CONSTANT, 1).set(AbcGeom.OInt16GeomParamSample(one, CONSTANT))
        Abc.OInt16Property(user, name).setValue(value)
    Abc.OStringProperty(user, "groom_tool").setValue(tool)


def integers(values, name, least=0):
    whole = numpy.rint(values)
    if (whole < least).any() or (whole > 2**31 - 1).any() or (whole != values).any():
        raise ValueError(f"{name}: whole numbers from {least} to {2**31 - 1} are needed")
    return whole.astype(numpy.int32)


def add_attribute(parent, name, values, is_strand, counts):
    scope, parts = UNIFORM if is_strand else VERTEX, values.shape[1]
    known = names.SCHEMA.get(name)
    if known and known.parts == parts and is_strand and known.kinds[-1] == "int32":
        whole = integers(values, name, known.least)
        return add(parent, "Int32", name, whole.ravel(), scope, parts)
    if known and known.scopes == ("vtx",) and is_strand:
        values, scope = numpy.repeat(values, counts, axis=0), VERTEX
    if parts in (2, 3):
        return add(parent, f"V{parts}f", name, floats(values), scope)
    return add(parent, "Float", name, floats(values).ravel(), scope, parts)


def plain(name):
    return "groom_" + re.sub(r"[^a-z0-9_]", "_", name.lower())


def attributes(arrays):
    """Schema name -> values (rows x parts), whether of strands."""
    found = {}
    for name, values in arrays.items():
        domain, _, rest = name.partition("_")
        if name in ("root_uv", "root_barycentrics", "root_triangle"):
            found[plain(name)] = (values.reshape(len(values), -1).astype(float), True)
        elif domain in ("strand", "vertex") and rest:
            found[plain(rest)] = (values.reshape(len(values), -1).astype(float), domain == "strand")
    return found


def write(source, target, unit, tool):
    with numpy.load(source) as file:
        arrays = {name: file[name] for name in file.files}
    counts = numpy.diff(arrays["offsets"].astype(numpy.int64)).astype(numpy.int32)
    places = floats(arrays["positions"].astype(float) / unit)
    widths = floats(2 * arrays["radii"].astype(float).ravel() / unit)
    archive = Abc.CreateArchiveWithInfo(target, tool, "a groom by the schema 1.5 of Unreal, y up")
    top = archive.getTop()
    Abc.ODoubleProperty(top.getProperties(), names.UNIT).setValue(unit)
    xform = AbcGeom.OXform(top, "groom")
    add_version(xform, tool)
    curves = AbcGeom.OCurves(xform, "strands").getSchema()
    held = imath.V3fArrayFromBuffer(places), imath.IntArrayFromBuffer(counts), imath.FloatArrayFromBuffer(widths)
    diameters = AbcGeom.OFloatGeomParamSample(held[2], VERTEX)
    # Without a basis: Blender takes linear curves of the default one, Bezier, for Bezier curves of a third of the points.
    curves.set(AbcGeom.OCurvesSchemaSample(held[0], held[1], AbcGeom.CurveType.kLinear, AbcGeom.CurvePeriodicity.kNonPeriodic, diameters,
                                           AbcGeom.OV2fGeomParamSample(), AbcGeom.ON3fGeomParamSample(), AbcGeom.BasisType.kNoBasis))
    parameters = curves.getArbGeomParams()
    add(parameters, "Float", "groom_width", widths, VERTEX)
    found = attributes(arrays)
    if "groom_id" not in found:
        add(parameters, "Int32", "groom_id", numpy.arange(len(counts), dtype=numpy.int32), UNIFORM)
    for name, (values, is_strand) in found.items():
        if name != "groom_width":
            add_attribute(parameters, name, values, is_strand, counts)
    return []
