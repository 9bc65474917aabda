"""Run by Blender's Python (bpy): blender_bvh.py CLIP.bvh JOINT FRAME OUT.json: how a joint turned and travelled from the clip's first frame to
this one (0: the first), as Blender imports it; y up, the file's units."""
import json
import pathlib
import sys

import bpy
from mathutils import Matrix

clip, joint, frame, out = sys.argv[1:5]
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.import_anim.bvh(filepath=clip, frame_start=0, use_fps_scale=False, rotate_mode="NATIVE", axis_forward="-Z", axis_up="Y")
armature = next(each for each in bpy.data.objects if each.type == "ARMATURE")
Y_UP = Matrix(((1, 0, 0, 0), (0, 0, 1, 0), (0, -1, 0, 0), (0, 0, 0, 1)))


def pose(at):
    bpy.context.scene.frame_set(at)
    return Y_UP @ armature.matrix_world @ armature.pose.bones[joint].matrix


first, now = pose(1), pose(1 + int(frame))  # frame 0 is the rest pose, which the importer puts before the clip
turn = now.to_3x3() @ first.to_3x3().inverted()
pathlib.Path(out).write_text(json.dumps({"turn": [list(row) for row in turn], "travel": list(now.translation - first.translation)}))
