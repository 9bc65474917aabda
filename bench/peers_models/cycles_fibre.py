"""The models `chiang` and `huang` against the principled hair BSDF of Blender's Cycles, on one fibre: the share of an even sky that it scatters, and
what it sends toward the camera across its width under a distant light.

  pip install bpy==5.0.1 OpenEXR numpy        (Python 3.11, in a virtual environment of its own; no display needed)
  CUTICLE=build/release/bin/cuticle python bench/peers_models/cycles_fibre.py chiang|huang [--samples 1024]

The fibre lies along x and the camera looks along -z from far (theta_o = 0). A distant light of irradiance 10: radiance over 10 is S.
"""
import argparse
import math
import os
import tempfile

import bpy
import mathutils
import numpy as np
import OpenEXR

from cuticle_eval import evaluate

PIXELS, RADIUS, IRRADIANCE = 44, 1e-3, 10.0
LIGHT = np.array([0.6, 0.9, 0.8]) / np.linalg.norm([0.6, 0.9, 0.8])
SIGMA_A = (0.06, 0.1, 0.2)


def make_scene(samples):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    cycles = scene.cycles
    cycles.samples, cycles.use_denoising, cycles.use_adaptive_sampling = samples, False, False
    for bounces in ("max_bounces", "transmission_bounces", "glossy_bounces", "diffuse_bounces"):
        setattr(cycles, bounces, 0)
    cycles.sample_clamp_indirect = cycles.blur_glossy = 0
    cycles.pixel_filter_type = "BOX"
    cycles.filter_width = 0.01
    scene.cycles_curves.shape = "THICK"
    scene.view_settings.view_transform = "Raw"
    render = scene.render
    render.film_transparent = True
    render.resolution_x = render.resolution_y = PIXELS
    render.image_settings.file_format, render.image_settings.color_depth = "OPEN_EXR", "32"
    return scene


def add_fibre(scene, material):
    points = 16
    curves = bpy.data.hair_curves.new("fibre")
    curves.add_curves([points])
    along = np.column_stack([np.linspace(-0.2, 0.2, points), np.zeros((points, 2))]).astype(np.float32)
    curves.attributes["position"].data.foreach_set("vector", along.ravel())
    if "radius" not in curves.attributes:
        curves.attributes.new("radius", "FLOAT", "POINT")
    curves.attributes["radius"].data.foreach_set("value", np.full(points, RADIUS, np.float32))
    curves.materials.append(material)
    scene.collection.objects.link(bpy.data.objects.new("fibre", curves))


def make_material(model, roughness, sigma_a):
    material = bpy.data.materials.new("hair")
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    shader = tree.nodes.new("ShaderNodeBsdfHairPrincipled")
    shader.model, shader.parametrization = model.upper(), "ABSORPTION"
    inputs = {"Absorption Coefficient": sigma_a, "Roughness": roughness, "IOR": 1.55, "Offset": 0.0, "Random Roughness": 0.0}
    inputs |= {"Radial Roughness": roughness, "Coat": 0.0} if model == "chiang" else {"Aspect Ratio": 1.0}
    for name, value in inputs.items():
        shader.inputs[name].default_value = value
    tree.links.new(shader.outputs[0], tree.nodes.new("ShaderNodeOutputMaterial").inputs[0])
    return material


def add_light(scene, furnace):
    if furnace:
        world = bpy.data.worlds.new("sky")
        scene.world = world
        world.use_nodes = True
        world.node_tree.nodes["Background"].inputs[0].default_value = (1, 1, 1, 1)
        return
    sun = bpy.data.lights.new("sun", "SUN")
    sun.energy, sun.angle = IRRADIANCE, 0
    placed = bpy.data.objects.new("sun", sun)
    placed.rotation_mode = "QUATERNION"
    placed.rotation_quaternion = mathutils.Vector(LIGHT).to_track_quat("Z", "Y")
    scene.collection.objects.link(placed)


def add_camera(scene):
    camera = bpy.data.cameras.new("camera")
    camera.type, camera.ortho_scale = "ORTHO", 2.2 * RADIUS
    placed = bpy.data.objects.new("camera", camera)
    placed.location = (0, 0, 1)
    scene.collection.objects.link(placed)
    scene.camera = placed


def cycles_profile(model, roughness, sigma_a, furnace, samples):
    """Radiance of each row across the fibre, top to bottom, and the offsets h = y / radius of the rows."""
    scene = make_scene(samples)
    add_fibre(scene, make_material(model, roughness, sigma_a))
    add_light(scene, furnace)
    add_camera(scene)
    with tempfile.TemporaryDirectory() as folder:
        scene.render.filepath = os.path.join(folder, "fibre.exr")
        bpy.ops.render.render(write_still=True)
        with OpenEXR.File(scene.render.filepath) as file:
            rows = file.channels()["RGBA"].pixels.astype(float).mean(1)
    y = (0.5 - (np.arange(PIXELS) + 0.5) / PIXELS) * 2.2
    seen = abs(y) < 1 - 1.1 / PIXELS
    return y[seen], rows[seen, :3]


def settings_of(model, roughness, sigma_a, field):
    absorbed = "/".join(map(str, sigma_a))
    if model == "chiang":
        return f"field={field},eta=1.55,beta_m={roughness},beta_n={roughness},alpha=0,sigma_a={absorbed}"
    return f"field={field},eta=1.55,roughness={roughness},tilt=0,aspect=1,samples=65536,sigma_a={absorbed}"


def compare(model, roughness, samples):
    for name, sigma_a in (("clear", (0.0, 0.0, 0.0)), ("sigma_a .06/.1/.2", SIGMA_A)):
        y, theirs = cycles_profile(model, roughness, sigma_a, True, samples)
        ours = evaluate(model, settings_of(model, roughness, sigma_a, "near"), "albedo", theta_o=np.zeros_like(y), h=y)
        whole = (ours + ours[::-1]) / 2
        print(f"{model} {roughness}: {name}: share of an even sky, ours {ours.mean(0).round(4)} Cycles {theirs.mean(0).round(4)} "
              f"ratio {(ours.mean(0) / theirs.mean(0)).round(4)}; across the width rms {np.sqrt(((whole - theirs)**2).mean() / (theirs**2).mean()):.4f}",
              flush=True)
    y, theirs = cycles_profile(model, roughness, SIGMA_A, False, samples)
    theirs /= IRRADIANCE
    phi = math.degrees(math.atan2(LIGHT[1], LIGHT[2]))
    points = {"theta_i": np.full_like(y, math.degrees(math.asin(LIGHT[0]))), "theta_o": np.zeros_like(y)}
    best = None
    for side in (1, -1):  # which way the offset counts
        ours = evaluate(model, settings_of(model, roughness, SIGMA_A, "near"), "S", phi=np.full_like(y, phi), h=side * y, **points)
        rms = np.sqrt(((ours - theirs)**2).mean() / (theirs**2).mean())
        if best is None or rms < best[0]:
            best = rms, ours.mean(0) / theirs.mean(0), side
    print(f"{model} {roughness}: S toward a light at theta_i {points['theta_i'][0]:.1f}, phi {phi:.1f}: mean ours / Cycles {best[1].round(4)}, "
          f"across the width rms {best[0]:.4f}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("model", choices=("chiang", "huang"))
    parser.add_argument("--samples", type=int, default=1024)
    parser.add_argument("--roughness", default="0.05,0.1,0.3,0.5")
    options = parser.parse_args()
    print(f"Blender {bpy.app.version_string}")
    for roughness in options.roughness.split(","):
        compare(options.model, float(roughness), options.samples)


main()
