"""One picture for compare.py by Blender's Cycles: python cycles_picture.py FOLDER PICTURE.npy BOUNCES SAMPLES SEED

Principled Hair with the Chiang model; its curves are Catmull-Rom splines through the points of the B-spline that the others draw.
"""
import json
import math
import os
import sys

import bpy
import mathutils
import numpy as np


def set_renderer(scene, bounces, samples, seed):
    scene.render.engine = "CYCLES"
    cycles = scene.cycles
    cycles.samples, cycles.seed = samples, seed
    cycles.use_denoising = cycles.use_adaptive_sampling = False
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = cycles.blur_glossy = 0
    cycles.pixel_filter_type, cycles.filter_width = "BOX", 1.0
    for kind in ("max_bounces", "transmission_bounces", "glossy_bounces", "diffuse_bounces"):
        setattr(cycles, kind, bounces - 1)
    scene.cycles_curves.shape = "THICK"
    scene.view_settings.view_transform = "Raw"
    scene.render.film_transparent = True


def add_hair(scene, fibre, path):
    with np.load(path) as file:
        counts, positions, radii = np.diff(file["offsets"].astype(int)), file["positions"], file["radii"]
    curves = bpy.data.hair_curves.new("hair")
    curves.add_curves(counts.tolist())
    curves.attributes["position"].data.foreach_set("vector", positions.ravel())
    if "radius" not in curves.attributes:
        curves.attributes.new("radius", "FLOAT", "POINT")
    curves.attributes["radius"].data.foreach_set("value", radii)
    curves.materials.append(material(fibre))
    scene.collection.objects.link(bpy.data.objects.new("hair", curves))


def material(fibre):
    made = bpy.data.materials.new("fibre")
    made.use_nodes = True
    tree = made.node_tree
    tree.nodes.clear()
    shader = tree.nodes.new("ShaderNodeBsdfHairPrincipled")
    shader.model, shader.parametrization = "CHIANG", "ABSORPTION"
    for name, value in (("Absorption Coefficient", fibre["sigma_a"]), ("Roughness", fibre["beta_m"]), ("Coat", 0),
                        ("Radial Roughness", fibre["beta_n"]), ("IOR", fibre["eta"]), ("Offset", 0),
                        ("Random Roughness", 0)):
        shader.inputs[name].default_value = value
    tree.links.new(shader.outputs[0], tree.nodes.new("ShaderNodeOutputMaterial").inputs[0])
    return made


def add_light(scene, light):
    sun = bpy.data.lights.new("sun", "SUN")
    sun.energy, sun.angle = light["irradiance"][0], 0
    sun_object = bpy.data.objects.new("sun", sun)
    sun_object.rotation_mode = "QUATERNION"
    sun_object.rotation_quaternion = mathutils.Vector(light["to_light"]).normalized().to_track_quat("Z", "Y")
    scene.collection.objects.link(sun_object)


def add_camera(scene, camera):
    eye, target = (mathutils.Vector(camera[key]) for key in ("position_m", "target_m"))
    lens = bpy.data.cameras.new("camera")
    lens.sensor_fit, lens.angle, lens.clip_start = "VERTICAL", math.radians(camera["fov_deg"]), 0.01
    backward = (eye - target).normalized()
    right = mathutils.Vector((0, 1, 0)).cross(backward).normalized()
    up = backward.cross(right)
    held = bpy.data.objects.new("camera", lens)
    scene.collection.objects.link(held)
    held.matrix_world = mathutils.Matrix([[right[k], up[k], backward[k], eye[k]] for k in range(3)] + [[0, 0, 0, 1]])
    scene.camera = held
    scene.render.resolution_x, scene.render.resolution_y = camera["resolution_px"]


def open_shutter(scene, camera, shutter):
    """The camera goes on as it went between two keys, and the mean over a time about the second is drawn."""
    held, way = scene.camera, mathutils.Vector(camera["keys"][1]["position_m"]) - mathutils.Vector(camera["keys"][0]["position_m"])
    for frame, at in ((0, held.location - way), (2, held.location + way)):
        held.location = at
        held.keyframe_insert("location", frame=frame)
    for curve in curves_of(held.animation_data.action):
        for key in curve.keyframe_points:
            key.interpolation = "LINEAR"
    scene.frame_set(1)
    scene.render.use_motion_blur, scene.render.motion_blur_shutter, scene.render.motion_blur_position = True, shutter, "CENTER"


def curves_of(action):
    """Of the only object that is animated."""
    return [curve for layer in action.layers for strip in layer.strips for bag in strip.channelbags for curve in bag.fcurves]


def drawn(scene, path):
    """The picture as an array, its first row at the top."""
    scene.render.image_settings.file_format, scene.render.image_settings.color_depth = "OPEN_EXR", "32"
    scene.render.filepath = path
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(path)
    image.colorspace_settings.name = "Non-Color"
    width, height = image.size
    return np.array(image.pixels[:], np.float32).reshape(height, width, 4)[::-1]


def main():
    folder, picture, bounces, samples, seed = sys.argv[1], sys.argv[2], *map(int, sys.argv[3:6])
    bpy.ops.wm.read_factory_settings(use_empty=True)
    with open(os.path.join(folder, "scene.json")) as file:
        asked = json.load(file)
    scene = bpy.context.scene
    set_renderer(scene, bounces, samples, seed)
    add_hair(scene, asked["material"]["model"]["chiang"], os.path.join(folder, "curves.npz"))
    add_light(scene, asked["lights"][0])
    add_camera(scene, asked["camera"])
    if "keys" in asked["camera"]:
        open_shutter(scene, asked["camera"], asked["passes"]["motion_blur"]["shutter"])
    np.save(picture, drawn(scene, picture.replace(".npy", ".exr")))


if __name__ == "__main__":
    main()
