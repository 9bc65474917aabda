"""Hair curves of Blender as grooms and back. Blender's z is up, Cuticle's y; both count metres."""
import bpy
import numpy


def to_blender(places):
    """(n, 3): x, -z, y."""
    places = numpy.asarray(places)
    return numpy.stack([places[:, 0], -places[:, 2], places[:, 1]], -1)


def from_blender(places):
    """(n, 3): x, z, -y."""
    places = numpy.asarray(places)
    return numpy.stack([places[:, 0], places[:, 2], -places[:, 1]], -1)


def read(attribute, name, count, components=1):
    """An attribute's numbers as float32."""
    found = numpy.empty(count * components, numpy.float32)
    attribute.data.foreach_get(name, found)
    return found.reshape(count, components) if components > 1 else found


def write_places(curves, places):
    """Places (points, 3) in the space of the object."""
    curves.attributes["position"].data.foreach_set("vector", numpy.ascontiguousarray(places, numpy.float32).ravel())
    curves.update_tag()


def local_places(curves):
    return read(curves.attributes["position"], "vector", len(curves.points), 3)


def counts(curves):
    """Points of each curve."""
    return numpy.array([curve.points_length for curve in curves.curves], numpy.int64)


def transformed(places, matrix):
    """Places through a matrix of Blender."""
    matrix = numpy.array(matrix)
    return places @ matrix[:3, :3].T + matrix[:3, 3]


def new_object(groom, name):
    """A groom as an object of hair curves, in the scene's collection."""
    offsets = numpy.asarray(groom.offsets)
    curves = bpy.data.hair_curves.new(name)
    curves.add_curves(numpy.diff(offsets).astype(int).tolist())
    write_places(curves, to_blender(numpy.asarray(groom.positions)))
    radius = curves.attributes.get("radius") or curves.attributes.new("radius", "FLOAT", "POINT")
    radius.data.foreach_set("value", numpy.ascontiguousarray(groom.radii, numpy.float32))
    if len(groom.root_uv):
        uv = curves.attributes.get("surface_uv_coordinate") or curves.attributes.new("surface_uv_coordinate", "FLOAT2", "CURVE")
        uv.data.foreach_set("vector", numpy.ascontiguousarray(groom.root_uv, numpy.float32).ravel())
    made = bpy.data.objects.new(name, curves)
    bpy.context.scene.collection.objects.link(made)
    return made


def groom_of(target, matrix=None):
    """An object's curves as a groom in world space, or in that of another matrix."""
    import cuticle

    curves, matrix = target.data, target.matrix_world if matrix is None else matrix
    count, scale = len(curves.points), abs(numpy.linalg.det(numpy.array(matrix)[:3, :3])) ** (1 / 3)
    radii = read(curves.attributes["radius"], "value", count) * scale if "radius" in curves.attributes else 35e-6
    uv = None
    if "surface_uv_coordinate" in curves.attributes:
        uv = read(curves.attributes["surface_uv_coordinate"], "vector", len(curves.curves), 2)
    return cuticle.make_groom(from_blender(transformed(local_places(curves), matrix)), counts(curves), radii, root_uv=uv)
