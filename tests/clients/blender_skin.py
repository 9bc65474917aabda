"""Run by Blender's Python (bpy): blender_skin.py CHARACTER.glb CLIP FRAMES.npz OUT.json: how far roots (in the file's units, y up; one array
for each time in seconds) lie from the skin that Blender draws."""
import json
import pathlib
import sys

import bpy
import numpy
from mathutils.bvhtree import BVHTree

character, clip, given, out = sys.argv[1:5]
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.import_scene.gltf(filepath=character)
armature = next(each for each in bpy.data.objects if each.type == "ARMATURE")
skin = max((each for each in bpy.data.objects if each.type == "MESH" and each.find_armature()), key=lambda each: len(each.data.vertices))
action = next(each for each in bpy.data.actions if each.name.split("_")[0] == clip or each.name == clip)
for track in armature.animation_data.nla_tracks:
    track.mute = True
armature.animation_data.action = action
if hasattr(armature.animation_data, "action_slot") and action.slots:
    armature.animation_data.action_slot = action.slots[0]
scene, found = bpy.context.scene, []
with numpy.load(given) as frames:
    for time, name in sorted((float(name), name) for name in frames.files):
        frame = time * scene.render.fps
        scene.frame_set(int(frame), subframe=frame - int(frame))
        graph = bpy.context.evaluated_depsgraph_get()
        drawn = skin.evaluated_get(graph)
        mesh = drawn.to_mesh()
        mesh.calc_loop_triangles()
        corners = [drawn.matrix_world @ vertex.co for vertex in mesh.vertices]
        tree = BVHTree.FromPolygons([(v.x, v.z, -v.y) for v in corners], [tuple(t.vertices) for t in mesh.loop_triangles])
        distances = [tree.find_nearest(tuple(map(float, root)))[3] for root in frames[name]]
        found.append({"time": time, "largest": max(distances), "mean": sum(distances) / len(distances), "roots": len(distances),
                      "size": max(max(v[c] for v in corners) - min(v[c] for v in corners) for c in range(3))})
pathlib.Path(out).write_text(json.dumps(found))
