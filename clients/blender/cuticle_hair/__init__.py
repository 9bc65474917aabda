"""Cuticle in Blender: grooms of every format in and out, hair curves simulated, lookup textures baked."""
import importlib
import os
import subprocess
import sys

import bpy
from bpy.props import EnumProperty, FloatProperty, IntProperty, PointerProperty, StringProperty

from . import motion, strands

bl_info = {"name": "Cuticle hair", "author": "Cuticle", "version": (0, 1, 0), "blender": (5, 0, 0), "category": "Object",
           "location": "3D view, sidebar, Cuticle", "description": "Grooms in and out, strand simulation and lookup textures by Cuticle"}


class Preferences(bpy.types.AddonPreferences):
    bl_idname = __package__
    folder: StringProperty(name="Folder of the module", subtype="DIR_PATH",
                           description="That of the Python module cuticle (build/release/python of its source tree); empty where pip installed it")

    def draw(self, _context):
        self.layout.prop(self, "folder")


def module():
    """The module cuticle, or None with the reason in words."""
    addon = bpy.context.preferences.addons.get(__package__)
    folder = bpy.path.abspath(addon.preferences.folder) if addon else ""
    if folder and folder not in sys.path:
        sys.path.append(folder)
    try:
        return importlib.import_module("cuticle"), ""
    except ImportError as missing:
        return None, f"{missing}: name the folder of the module cuticle in the add-on's preferences"


class Action:
    """What the operators share: they say why in words where they cannot go on."""

    def execute(self, context):
        cuticle, why = module()
        if cuticle is None:
            self.report({"ERROR"}, why)
            return {"CANCELLED"}
        try:
            self.report({"INFO"}, self.run(context, cuticle))
            return {"FINISHED"}
        except (cuticle.Error, OSError, ValueError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}


def hair_chosen(context):
    return context.object is not None and context.object.type == "CURVES"


class ImportGroom(Action, bpy.types.Operator):
    """Hair curves from a groom of any format that Cuticle reads"""

    bl_idname, bl_label, bl_options = "cuticle.import_groom", "Import groom", {"UNDO"}
    filepath: StringProperty(subtype="FILE_PATH")
    metres_per_unit: FloatProperty(name="Metres per unit", default=0, min=0, description="0: as the file says, or guessed")

    def invoke(self, context, _event):
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def run(self, context, cuticle):
        groom = cuticle.load_groom(self.filepath, metres_per_unit=self.metres_per_unit)
        made = strands.new_object(groom, bpy.path.display_name_from_filepath(self.filepath))
        context.view_layer.objects.active = made
        return f"{len(made.data.curves)} strands, {len(made.data.points)} points"


class ExportGroom(Action, bpy.types.Operator):
    """The hair curves chosen as a groom; the file's ending says the format"""

    bl_idname, bl_label = "cuticle.export_groom", "Export groom"
    filepath: StringProperty(subtype="FILE_PATH")
    poll = classmethod(lambda cls, context: hair_chosen(context))

    def invoke(self, context, _event):
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def run(self, context, cuticle):
        return "; ".join([self.filepath, *cuticle.write(strands.groom_of(context.object), self.filepath)])


class Simulate(Action, bpy.types.Operator):
    """Hair curves that fall, swing with their object and lie on a mesh"""

    bl_idname, bl_label, bl_options = "cuticle.simulate", "Simulate", {"UNDO"}
    first: IntProperty(name="First frame", default=1)
    last: IntProperty(name="Last frame", default=100)
    solver: EnumProperty(name="Solver", items=[("exact", "exact", "chains of links that keep their length"), ("rod", "rod", "fibres that bend and twist"),
                                               ("classic", "classic", "position-based, as engines have it")])
    poll = classmethod(lambda cls, context: hair_chosen(context))

    def invoke(self, context, _event):
        self.first, self.last = context.scene.frame_start, context.scene.frame_end
        return context.window_manager.invoke_props_dialog(self)

    def run(self, context, cuticle):
        if self.last < self.first:
            raise ValueError(f"last frame {self.last} is before the first, {self.first}")
        scene, target, now = context.scene, context.object, context.scene.frame_current
        motion.forget(target)
        context.window_manager.progress_begin(0, 1)
        places = motion.simulate(scene, target, self.first, self.last, self.solver, scene.cuticle_collider, progress=context.window_manager.progress_update)
        context.window_manager.progress_end()
        motion.keep(target, places, self.first)
        scene.frame_set(now)
        return f"{len(places)} frames in {target[motion.KEY]}"


class ForgetMotion(Action, bpy.types.Operator):
    """The hair as it was before the simulation"""

    bl_idname, bl_label, bl_options = "cuticle.forget_motion", "Forget motion", {"UNDO"}
    poll = classmethod(lambda cls, context: hair_chosen(context) and motion.KEY in context.object)

    def run(self, context, cuticle):
        motion.forget(context.object)
        return "at rest"


class BakeTables(Action, bpy.types.Operator):
    """Lookup textures of a hair, for an engine"""

    bl_idname, bl_label = "cuticle.bake_tables", "Bake lookup textures"
    directory: StringProperty(subtype="DIR_PATH")
    hair: StringProperty(name="Hair", default="blond", description="A preset of the model marschner: blond, brown, black ..")
    size: IntProperty(name="Size", default=128, min=16, max=1024)
    format: EnumProperty(name="Format", items=[("exr", "EXR", "half floats"), ("ktx2", "KTX2", "half floats"), ("dds", "DDS", "half floats")])

    def invoke(self, context, _event):
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def run(self, context, cuticle):
        # In a process of its own: Blender's and the system's picture libraries do not bear each other in one.
        work = "import sys, cuticle; cuticle.bake('marschner', 'auto', int(sys.argv[1]), preset=sys.argv[2], format=sys.argv[3], out=sys.argv[4])"
        folder = os.path.dirname(os.path.dirname(cuticle.__file__))
        done = subprocess.run([sys.executable, "-c", work, str(self.size), self.hair, self.format, self.directory], capture_output=True, text=True,
                              env={**os.environ, "PYTHONPATH": folder})
        if done.returncode:
            raise ValueError(done.stderr.strip().splitlines()[-1])
        return f"tables in {self.directory}"


class Panel(bpy.types.Panel):
    bl_idname, bl_label, bl_space_type, bl_region_type, bl_category = "CUTICLE_PT_hair", "Cuticle", "VIEW_3D", "UI", "Cuticle"

    def draw(self, context):
        for action in (ImportGroom, ExportGroom, Simulate, ForgetMotion, BakeTables):
            self.layout.operator(action.bl_idname)
        self.layout.prop(context.scene, "cuticle_collider")


CLASSES = (Preferences, ImportGroom, ExportGroom, Simulate, ForgetMotion, BakeTables, Panel)


def register():
    for each in CLASSES:
        bpy.utils.register_class(each)
    bpy.types.Scene.cuticle_collider = PointerProperty(type=bpy.types.Object, name="Lies on", poll=lambda _scene, target: target.type == "MESH",
                                                       description="A mesh that moves with the hair's object")
    bpy.app.handlers.frame_change_post.append(motion.show)


def unregister():
    bpy.app.handlers.frame_change_post.remove(motion.show)
    del bpy.types.Scene.cuticle_collider
    for each in reversed(CLASSES):
        bpy.utils.unregister_class(each)
