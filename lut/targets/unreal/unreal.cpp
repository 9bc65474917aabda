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

Result<std::vector<TextFile>> files(const Manifest& manifest) {
  CUTICLE_TRY(check_readable(manifest, "unreal", k_readable));
  std::string textures;
  for (const ManifestTable& table : manifest.tables)
    textures += fmt::format("Texture2D cuticle_{0};\nSamplerState cuticle_{0}Sampler;\n", table.name);
  // Both store uncompressed: four halves, or four bytes.
  const std::string compression = manifest.format == "exr" ? "TC_HDR" : "TC_VECTOR_DISPLACEMENTMAP";
  const std::pair<std::string_view, std::string> values[] = {
      {"VERSION", manifest.tool_version}, {"COMPRESSION", compression}, {"TEXTURES", textures}};
  CUTICLE_ASSIGN(const std::string include, engine_snippet(manifest, "hlsl", filled(k_include_head, values)));
  return std::vector<TextFile>{{"import_cuticle_lut.py", filled(k_script, values)}, {"CuticleHair.ush", include}};
}

}  // namespace

const Target& entry() {
  static const Target target{"unreal", "import_cuticle_lut.py, CuticleHair.ush", files};
  return target;
}

}  // namespace cuticle::lut::unreal
