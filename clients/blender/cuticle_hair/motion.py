"""Hair curves simulated by Cuticle, kept as a file of places per frame and shown as the timeline moves."""
import os
import tempfile

import bpy
import numpy
from mathutils import Matrix

from . import strands

KEY = "cuticle_motion"  # the object's property that names the file
_loaded = {}

# Blender's axes as Cuticle's: y up.
TURN = Matrix(((1, 0, 0, 0), (0, 0, 1, 0), (0, -1, 0, 0), (0, 0, 0, 1)))


def rigid(matrix):
    """Its turn and place without its scale."""
    place, turn, _ = matrix.decompose()
    return Matrix.LocRotScale(place, turn, None)


def world_at(scene, target, frame):
    scene.frame_set(frame)
    return target.evaluated_get(bpy.context.evaluated_depsgraph_get()).matrix_world.copy()


def collider_of(scene, target, spacing):
    """A mesh, as it is drawn at this frame: places, triangles, spacing of its distance field."""
    drawn = target.evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = drawn.to_mesh()
    mesh.calc_loop_triangles()
    places = numpy.array([drawn.matrix_world @ vertex.co for vertex in mesh.vertices])
    triangles = numpy.array([triangle.vertices[:] for triangle in mesh.loop_triangles], numpy.uint32)
    drawn.to_mesh_clear()
    return strands.from_blender(places), triangles, spacing


def simulate(scene, target, first, last, solver="exact", collider=None, spacing=0.005, settings=None, progress=None):
    """Places (frames, points, 3) in the object's own space. The hair's roots, and the collider, move with the object.

    The rest shape is that of the first frame. The object's motion counts without its scale.
    """
    import cuticle

    start = world_at(scene, target, first)
    groom = strands.groom_of(target, start)
    effects = ["gravity", "colliders"] if collider else ["gravity"]
    meshes = [collider_of(scene, collider, spacing)] if collider else None
    made = cuticle.simulate(groom, solver, effects, frames_per_second=scene.render.fps / scene.render.fps_base, meshes=meshes, **(settings or {}))
    found, back = [], rigid(start).inverted()
    for frame in range(first, last + 1):
        world = world_at(scene, target, frame)
        if frame > first:
            head = TURN @ (rigid(world) @ back) @ TURN.inverted()
            state = made.step(1, head=numpy.array(head))
            found.append(strands.transformed(strands.to_blender(state.positions), world.inverted()).astype(numpy.float32))
        else:
            found.append(strands.local_places(target.data).copy())
        if progress:
            progress((frame - first + 1) / (last - first + 1))
    return numpy.array(found)


def file_for(target):
    """Beside the .blend, or where temporary files are while there is none."""
    folder = bpy.path.abspath("//cuticle") if bpy.data.filepath else os.path.join(tempfile.gettempdir(), "cuticle_hair")
    os.makedirs(folder, exist_ok=True)
    return os.path.join(folder, bpy.path.clean_name(target.name) + ".npz")


def keep(target, places, first):
    """Writes the motion, and has it shown from now on."""
    path = file_for(target)
    numpy.savez(path, places=places, first=first, rest=places[0])
    target[KEY] = path
    _loaded.pop(path, None)


def forget(target):
    """The hair as it was at rest; the file stays."""
    if KEY in target:
        strands.write_places(target.data, motion_of(target)["rest"])
        del target[KEY]


def motion_of(target):
    path = target[KEY]
    if path not in _loaded:
        with numpy.load(path) as arrays:
            _loaded[path] = {name: arrays[name] for name in arrays.files}
    return _loaded[path]


@bpy.app.handlers.persistent
def show(scene, _graph=None):
    """The places of the scene's frame, of every object that has a motion; before it the first, after it the last."""
    for target in scene.objects:
        if target.type == "CURVES" and KEY in target and os.path.exists(target[KEY]):
            motion = motion_of(target)
            frame = min(max(scene.frame_current - int(motion["first"]), 0), len(motion["places"]) - 1)
            strands.write_places(target.data, motion["places"][frame])
