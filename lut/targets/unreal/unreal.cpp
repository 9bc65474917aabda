// Settings by their documented names: Unreal Engine 5's Python API.
#include <fmt/format.h>

#include "lut/target.h"

namespace cuticle::lut::unreal {
namespace {

constexpr std::string_view k_readable[] = {"exr", "png8"};

constexpr const char* k_script = R"("""Imports the tables beside this file as data. Written by cuticle @VERSION@.

In the editor: Tools > Execute Python Script, or `py import_cuticle_lut.py` in its console.
"""
import json
import os

import unreal

DESTINATION = "/Game/Cuticle"
SETTINGS = {
    "srgb": False,
    "compression_settings": unreal.TextureCompressionSettings.@COMPRESSION@,
    "mip_gen_settings": unreal.TextureMipGenSettings.TMGS_NO_MIPMAPS,
    "filter": unreal.TextureFilter.TF_BILINEAR,
    "address_x": unreal.TextureAddress.TA_CLAMP,
    "address_y": unreal.TextureAddress.TA_CLAMP,
    "never_stream": True,
}


def import_table(path):
    task = unreal.AssetImportTask()
    for name, value in {"filename": path, "destination_path": DESTINATION, "automated": True, "replace_existing": True,
                        "save": False}.items():
        task.set_editor_property(name, value)
    unreal.AssetToolsHelpers.get_asset_tools().import_asset_tasks([task])
    for asset in task.get_editor_property("imported_object_paths"):
        texture = unreal.EditorAssetLibrary.load_asset(asset)
        for name, value in SETTINGS.items():
            texture.set_editor_property(name, value)
        unreal.EditorAssetLibrary.save_asset(asset)
        unreal.log("cuticle: imported " + asset)


def main():
    folder = os.path.dirname(os.path.abspath(__file__))
    with open(os.path.join(folder, "manifest.json"), encoding="utf-8") as file:
        manifest = json.load(file)
    for table in manifest["tables"]:
        import_table(os.path.join(folder, table["file"]))


main()
)";

constexpr const char* k_include_head = R"(#pragma once
// For the global shaders of a plug-in: bind each texture with a bilinear, clamped sampler.
@TEXTURES@#define CUTICLE_SAMPLE(table, uv) table.SampleLevel(table##Sampler, uv, 0)
)";

// A Custom node's textures are arguments of its function, so that the functions are members of a structure that holds them.
constexpr const char* k_node_head = R"(// The code of a Custom node: inputs light, eye, tangent and the tables as texture objects.
#define CUTICLE_SAMPLE(table, uv) table.SampleLevel(table##Sampler, uv, 0)
struct CuticleHair {
@MEMBERS@)";
constexpr const char* k_node_tail = R"(};
CuticleHair hair;
@ASSIGNMENTS@float sine = dot(light, tangent);
return hair.cuticle_hair_scattering(light, eye, tangent) * sqrt(saturate(1 - sine * sine));
)";

constexpr const char* k_material = R"("""Makes the material /Game/Cuticle/M_CuticleHair of the imported tables. Written by cuticle @VERSION@.

Run import_cuticle_lut.py first. The light is the scene's atmosphere sun, in front of a parameter for its irradiance.
"""
import json
import os

import unreal

FOLDER = "/Game/Cuticle"
EDITING = unreal.MaterialEditingLibrary


def node(material, kind, x, y, **properties):
    made = EDITING.create_material_expression(material, kind, x, y)
    for name, value in properties.items():
        made.set_editor_property(name, value)
    return made


def custom_input(name):
    made = unreal.CustomInput()
    made.set_editor_property("input_name", name)
    return made


def main():
    folder = os.path.dirname(os.path.abspath(__file__))
    with open(os.path.join(folder, "CuticleHairNode.ush"), encoding="utf-8") as file:
        code = file.read()
    with open(os.path.join(folder, "manifest.json"), encoding="utf-8") as file:
        tables = json.load(file)["tables"]
    material = unreal.AssetToolsHelpers.get_asset_tools().create_asset("M_CuticleHair", FOLDER, unreal.Material, unreal.MaterialFactoryNew())
    material.set_editor_property("shading_model", unreal.MaterialShadingModel.MSM_UNLIT)
    material.set_editor_property("two_sided", True)
    names = ["light", "eye", "tangent"] + ["cuticle_" + table["name"] for table in tables]
    custom = node(material, unreal.MaterialExpressionCustom, -400, 0, code=code, description="Cuticle hair",
                  output_type=unreal.CustomMaterialOutputType.CMOT_FLOAT3, inputs=[custom_input(name) for name in names])
    sources = [node(material, unreal.MaterialExpressionSkyAtmosphereLightDirection, -900, 0),
               node(material, unreal.MaterialExpressionCameraVectorWS, -900, 120),
               node(material, unreal.MaterialExpressionVertexTangentWS, -900, 240)]
    for place, table in enumerate(tables):
        texture = unreal.EditorAssetLibrary.load_asset(FOLDER + "/" + os.path.splitext(table["file"])[0])
        sources.append(node(material, unreal.MaterialExpressionTextureObject, -900, 360 + 160 * place, texture=texture))
    for name, source in zip(names, sources):
        EDITING.connect_material_expressions(source, "", custom, name)
    irradiance = node(material, unreal.MaterialExpressionVectorParameter, -400, 300, parameter_name="Irradiance",
                      default_value=unreal.LinearColor(3.0, 3.0, 3.0, 1.0))
    product = node(material, unreal.MaterialExpressionMultiply, -150, 100)
    EDITING.connect_material_expressions(custom, "", product, "A")
    EDITING.connect_material_expressions(irradiance, "", product, "B")
    EDITING.connect_material_property(product, "", unreal.MaterialProperty.MP_EMISSIVE_COLOR)
    EDITING.recompile_material(material)
    unreal.EditorAssetLibrary.save_asset(FOLDER + "/M_CuticleHair")


main()
)";

constexpr const char* k_readme = R"(# Hair tables for Unreal Engine 5

@TABLES@ of the model @MODEL@, written by cuticle @VERSION@.

1. In the editor, Tools > Execute Python Script: `import_cuticle_lut.py`. It imports the tables to `/Game/Cuticle` as data:
   linear, clamped, uncompressed, without mip maps.
2. In the same way `make_cuticle_material.py`. It makes the material `/Game/Cuticle/M_CuticleHair`, lit by the atmosphere's
   sun; give it to hair strips or cards whose tangents run from root to tip.
3. Export a table again and run `cuticle check lut FOLDER`: it says whether the numbers are still right, and if not which
   mistake was made.

`CuticleHair.ush` holds the functions for global shaders of a plug-in; the result is scattering without the cosine of the
light's inclination. These files follow Unreal's documented names; nobody has opened them in the editor yet.
)";

/// The code of a material's Custom node.
Result<std::string> node_code(const Manifest& manifest) {
  std::string members, assignments;
  for (const ManifestTable& table : manifest.tables) {
    members += fmt::format("Texture2D cuticle_{0};\nSamplerState cuticle_{0}Sampler;\n", table.name);
    assignments += fmt::format("hair.cuticle_{0} = cuticle_{0};\nhair.cuticle_{0}Sampler = cuticle_{0}Sampler;\n", table.name);
  }
  const std::pair<std::string_view, std::string> head[] = {{"MEMBERS", members}};
  const std::pair<std::string_view, std::string> tail[] = {{"ASSIGNMENTS", assignments}};
  CUTICLE_ASSIGN(const std::string functions, engine_snippet(manifest, "hlsl", filled(k_node_head, head)));
  return functions + filled(k_node_tail, tail);
}

Result<std::vector<TextFile>> files(const Manifest& manifest) {
  CUTICLE_TRY(check_readable(manifest, "unreal", k_readable));
  std::string textures;
  for (const ManifestTable& table : manifest.tables)
    textures += fmt::format("Texture2D cuticle_{0};\nSamplerState cuticle_{0}Sampler;\n", table.name);
  // Both store uncompressed: four halves, or four bytes.
  const std::string compression = manifest.format == "exr" ? "TC_HDR" : "TC_VECTOR_DISPLACEMENTMAP";
  const std::pair<std::string_view, std::string> values[] = {
      {"VERSION", manifest.tool_version}, {"COMPRESSION", compression},
      {"TEXTURES", textures},             {"MODEL", manifest.model},
      {"TABLES", names_of_tables(manifest)}};
  CUTICLE_ASSIGN(const std::string include, engine_snippet(manifest, "hlsl", filled(k_include_head, values)));
  std::vector<TextFile> made = {{"import_cuticle_lut.py", filled(k_script, values)},
                                {"CuticleHair.ush", include},
                                {"README.md", filled(k_readme, values)}};
  if (manifest.terms.empty()) return made;  // tables that do not make S shade nothing by themselves
  CUTICLE_ASSIGN(const std::string node, node_code(manifest));
  made.push_back({"make_cuticle_material.py", filled(k_material, values)});
  made.push_back({"CuticleHairNode.ush", node});
  return made;
}

}  // namespace

const Target& entry() {
  static const Target target{"unreal", "scripts that import the tables and make a material, CuticleHair.ush", files};
  return target;
}

}  // namespace cuticle::lut::unreal
