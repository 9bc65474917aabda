"""Run by Blender's Python (bpy): opens what Cuticle wrote, prints what it found as JSON, and draws the strands by Cycles.
blender_open.py FOLDER: groom.usda, cards.glb, cards.obj and strands.glb in; blender_chiang.png and blender_huang.png out."""
import json
import math
import pathlib
import sys

import bpy
import numpy
from mathutils import Vector

WORK = pathlib.Path(sys.argv[1])


def emptied():
    bpy.ops.wm.read_factory_settings(use_empty=True)


def values(attribute, name, count, components=1):
    found = numpy.empty(count * components, numpy.float32)
    attribute.data.foreach_get(name, found)
    return found.reshape(count, components) if components > 1 else found


def curves(file="groom.usda", arrays="blender_curves.npz"):
    """The one curves object that a groom's USD or Alembic becomes, and its arrays in world units."""
    emptied()
    if file.endswith(".abc"):
        bpy.ops.wm.alembic_import(filepath=str(WORK / file), scale=0.01, as_background_job=False)
    else:
        bpy.ops.wm.usd_import(filepath=str(WORK / file))
    made = next(each for each in bpy.data.objects if each.type == "CURVES")
    data, count = made.data, len(made.data.points)
    places = values(data.attributes["position"], "vector", count, 3)
    matrix = numpy.array(made.matrix_world)
    numpy.savez(WORK / arrays, positions=places @ matrix[:3, :3].T + matrix[:3, 3], radii=values(data.attributes["radius"], "value", count),
                offsets=numpy.array([curve.first_point_index for curve in data.curves] + [count]))
    return made, {"curves": len(data.curves), "points": count, "attributes": sorted(each.name for each in data.attributes)}


def mesh_of(operator, name, **options):
    emptied()
    operator(filepath=str(WORK / name), **options)
    made = next(each for each in bpy.data.objects if each.type == "MESH")
    corners = numpy.array([made.matrix_world @ vertex.co for vertex in made.data.vertices])
    material = made.data.materials[0] if made.data.materials else None
    images = [node.image.name for node in material.node_tree.nodes if node.type == "TEX_IMAGE"] if material and material.node_tree else []
    return {"vertices": len(made.data.vertices), "edges": len(made.data.edges), "faces": len(made.data.polygons), "uv": [each.name for each in made.data.uv_layers],
            "lower": corners.min(axis=0).tolist(), "upper": corners.max(axis=0).tolist(), "images": images}


def hair_material(model, sigma_a, eta, roughness):
    material = bpy.data.materials.new("hair")
    material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    nodes.clear()
    fibre, out = nodes.new("ShaderNodeBsdfHairPrincipled"), nodes.new("ShaderNodeOutputMaterial")
    fibre.model, fibre.parametrization = model, "ABSORPTION"
    fibre.inputs["Absorption Coefficient"].default_value = sigma_a
    fibre.inputs["IOR"].default_value = eta
    for name in ("Roughness", "Radial Roughness"):
        if name in fibre.inputs:
            fibre.inputs[name].default_value = roughness
    links.new(fibre.outputs[0], out.inputs[0])
    return material


def draw(model, name):
    made, _ = curves()
    made.data.materials.append(hair_material(model, (0.126, 0.209, 0.411), 1.55, 0.3))
    made.data.attributes["radius"].data.foreach_set("value", 2.5 * values(made.data.attributes["radius"], "value", len(made.data.points)))
    scene = bpy.context.scene
    places = numpy.load(WORK / "blender_curves.npz")["positions"]
    center = Vector((places.min(axis=0) + places.max(axis=0)) / 2)
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.data.angle = math.radians(24)
    camera.location = center + 1.1 * Vector((0.55, -0.82, 0.2))
    camera.rotation_euler = (center - camera.location).to_track_quat("-Z", "Y").to_euler()
    light = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
    light.data.energy = 9
    light.rotation_euler = Vector((-0.55, 0.63, -0.55)).to_track_quat("-Z", "Y").to_euler()
    for each in (camera, light):
        scene.collection.objects.link(each)
    scene.world = bpy.data.worlds.new("world")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs[0].default_value = (0.06, 0.065, 0.07, 1)
    scene.camera, scene.render.engine, scene.cycles.samples, scene.cycles.device = camera, "CYCLES", 40, "CPU"
    scene.cycles.use_denoising, scene.cycles.max_bounces, scene.cycles.transmission_bounces = False, 64, 64
    scene.cycles.glossy_bounces = 64
    scene.render.threads_mode, scene.render.threads = "FIXED", 2
    scene.render.resolution_x = scene.render.resolution_y = 400
    scene.render.filepath = str(WORK / name)
    bpy.ops.render.render(write_still=True)


def main():
    found = {"version": bpy.app.version_string, "usda": curves()[1],
             "abc": curves("groom.abc", "blender_abc.npz")[1], "cards.glb": mesh_of(bpy.ops.import_scene.gltf, "cards.glb"),
             "strands.glb": mesh_of(bpy.ops.import_scene.gltf, "strands.glb"), "cards.obj": mesh_of(bpy.ops.wm.obj_import, "cards.obj")}
    draw("CHIANG", "blender_chiang.png")
    draw("HUANG", "blender_huang.png")
    (WORK / "blender.json").write_text(json.dumps(found))


main()
