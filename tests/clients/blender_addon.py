"""Run by Blender's Python (bpy): the add-on on a groom. blender_addon.py GROOM FOLDER OUT.json, with the module cuticle on PYTHONPATH."""
import json
import math
import pathlib
import sys

import bpy
import numpy
from mathutils import Vector

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "clients/blender"))
import cuticle_hair  # noqa: E402
from cuticle_hair import motion, strands  # noqa: E402

import cuticle  # noqa: E402

groom_file, folder, out = sys.argv[1], pathlib.Path(sys.argv[2]), sys.argv[3]
bpy.ops.wm.read_factory_settings(use_empty=True)
cuticle_hair.register()
truth, found = cuticle.load_groom(groom_file), {"version": bpy.app.version_string}

bpy.ops.cuticle.import_groom(filepath=groom_file)
hair = bpy.context.object
assert strands.counts(hair.data).tolist() == numpy.diff(truth.offsets).tolist()
bpy.ops.cuticle.export_groom(filepath=str(folder / "back.npz"))
back = cuticle.load_groom(str(folder / "back.npz"))
found["places_off"] = float(abs(back.positions - truth.positions).max())
found["radii_off"] = float(abs(back.radii - truth.radii).max())

# A quarter turn of the head in ten frames, then at rest.
bpy.context.scene.render.fps = 30
hair.rotation_mode = "XYZ"
for frame, angle in ((1, 0.0), (11, math.pi / 2)):
    hair.rotation_euler = (0, 0, angle)
    hair.keyframe_insert("rotation_euler", frame=frame)
before = strands.local_places(hair.data)
bpy.ops.cuticle.simulate(first=1, last=20, solver="exact")
roots = numpy.concatenate([[0], numpy.cumsum(strands.counts(hair.data))[:-1]])
rest = numpy.diff(before, axis=0)
inside = numpy.ones(len(before) - 1, bool)
inside[roots[1:] - 1] = False
moved, stretched, root_off = 0.0, 0.0, 0.0
for frame in range(1, 21):
    bpy.context.scene.frame_set(frame)
    places = strands.local_places(hair.data)
    length = numpy.linalg.norm(numpy.diff(places, axis=0)[inside], axis=1) / numpy.linalg.norm(rest[inside], axis=1)
    stretched, moved = max(stretched, abs(length - 1).max()), max(moved, abs(places - before).max())
    root_off = max(root_off, abs(places[roots] - before[roots]).max())
found |= {"stretched": float(stretched), "moved": float(moved), "root_off": float(root_off)}

# The same by the module alone: the add-on's motion is the solver's.
turns = [numpy.array(motion.TURN @ motion.rigid(motion.world_at(bpy.context.scene, hair, frame)) @ motion.TURN.inverted()) for frame in range(2, 21)]
alone = cuticle.simulate(truth, "exact", ["gravity"], frames_per_second=30)
for head in turns:
    state = alone.step(1, head=head)
bpy.context.scene.frame_set(20)
world = strands.from_blender(strands.transformed(strands.local_places(hair.data), hair.matrix_world))
found["from_module"] = float(abs(world - state.positions).max())

bpy.ops.cuticle.forget_motion()
found["forgotten"] = float(abs(strands.local_places(hair.data) - before).max())
bpy.ops.cuticle.bake_tables(directory=str(folder / "baked"), size=16)
found["baked"] = sorted(each.name for each in (folder / "baked").iterdir())

# A ball in the hair, which must make room for it.
bpy.context.scene.frame_set(1)
hair.animation_data_clear()
hair.rotation_euler = (0, 0, 0)
bpy.context.view_layer.update()
center, radius = strands.transformed(before, hair.matrix_world)[-5], 0.03
bpy.ops.mesh.primitive_uv_sphere_add(radius=radius, location=center, segments=48, ring_count=24)
bpy.context.scene.cuticle_collider = bpy.context.object
bpy.context.view_layer.objects.active = hair
bpy.ops.cuticle.simulate(first=1, last=40, solver="exact")
bpy.context.scene.frame_set(40)
away = numpy.linalg.norm(strands.transformed(strands.local_places(hair.data), hair.matrix_world) - center, axis=1)
was = numpy.linalg.norm(strands.transformed(before, hair.matrix_world) - center, axis=1)
free = numpy.ones(len(before), bool)
free[numpy.concatenate([roots, roots + 1])] = False
found |= {"inside_before": int((was[free] < radius - 0.003).sum()), "inside": int((away[free] < radius - 0.003).sum())}

scene = bpy.context.scene
bpy.context.scene.cuticle_collider.hide_render = False
camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
middle = Vector(center.tolist())
camera.location = middle + 0.75 * Vector((0.55, -0.82, 0.2))
camera.rotation_euler = (middle - camera.location).to_track_quat("-Z", "Y").to_euler()
light = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
light.data.energy, light.rotation_euler = 9, Vector((-0.55, 0.63, -0.55)).to_track_quat("-Z", "Y").to_euler()
for each in (camera, light):
    scene.collection.objects.link(each)
scene.world = bpy.data.worlds.new("world")
scene.world.color = (0.06, 0.065, 0.07)
radii = hair.data.attributes["radius"]
radii.data.foreach_set("value", 2.5 * strands.read(radii, "value", len(hair.data.points)))  # as many as are there must cover
scene.camera, scene.render.engine, scene.cycles.samples, scene.cycles.device, scene.cycles.use_denoising = camera, "CYCLES", 24, "CPU", True
scene.render.threads_mode, scene.render.threads, scene.render.resolution_x, scene.render.resolution_y = "FIXED", 2, 320, 320
material = bpy.data.materials.new("hair")
material.use_nodes = True
material.node_tree.nodes.clear()
fibre, end = (material.node_tree.nodes.new(f"Shader{each}") for each in ("NodeBsdfHairPrincipled", "NodeOutputMaterial"))
fibre.parametrization = "ABSORPTION"
fibre.inputs["Absorption Coefficient"].default_value = (0.126, 0.209, 0.411)
material.node_tree.links.new(fibre.outputs[0], end.inputs[0])
hair.data.materials.append(material)
scene.render.filepath = str(folder / "blender_addon.png")
bpy.ops.render.render(write_still=True)
cuticle_hair.unregister()
pathlib.Path(out).write_text(json.dumps(found))
