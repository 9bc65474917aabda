// Settings by their documented names: Unity's TextureImporter, AssetPostprocessor, TextureImporterFormat.
#include <fmt/format.h>

#include "lut/probes.h"
#include "lut/target.h"
#include "lut/targets/unity/materials.h"

namespace cuticle::lut::unity {
namespace {

constexpr std::string_view k_readable[] = {"exr", "png8", "png16"};

constexpr const char* k_meta = R"(fileFormatVersion: 2
guid: @GUID@
TextureImporter:
  serializedVersion: 11
  mipmaps:
    mipMapMode: 0
    enableMipMap: 0
    sRGBTexture: 0
    linearTexture: 0
  isReadable: 0
  textureSettings:
    serializedVersion: 2
    filterMode: 1
    aniso: 0
    mipBias: 0
    wrapU: 1
    wrapV: 1
    wrapW: 1
  nPOTScale: 0
  alphaUsage: 1
  alphaIsTransparency: 0
  textureType: 0
  textureShape: 1
  platformSettings:
  - serializedVersion: 3
    buildTarget: DefaultTexturePlatform
    maxTextureSize: 16384
    textureFormat: @TEXTURE_FORMAT@
    textureCompression: 0
    crunchedCompression: 0
    overridden: 0
)";

// Beside the .meta files because a folder that was copied without them is imported with Unity's defaults for colour.
constexpr const char* k_importer =
    R"(// Written by cuticle @VERSION@. Imports the tables of a folder that holds cuticle's manifest.json as data.
#if UNITY_EDITOR
using System.IO;
using UnityEditor;
using UnityEngine;

public class CuticleLutImporter : AssetPostprocessor
{
    void OnPreprocessTexture()
    {
        string folder = Path.GetDirectoryName(assetPath), manifest = Path.Combine(folder, "manifest.json");
        if (!File.Exists(manifest)) return;
        string text = File.ReadAllText(manifest);
        if (!text.Contains("\"tool\": \"cuticle\"") || !text.Contains("\"file\": \"" + Path.GetFileName(assetPath) + "\"")) return;
        var importer = (TextureImporter)assetImporter;
        importer.textureType = TextureImporterType.Default;
        importer.sRGBTexture = false;
        importer.mipmapEnabled = false;
        importer.wrapMode = TextureWrapMode.Clamp;
        importer.filterMode = FilterMode.Bilinear;
        importer.npotScale = TextureImporterNPOTScale.None;
        importer.alphaSource = TextureImporterAlphaSource.FromInput;
        importer.alphaIsTransparency = false;
        importer.textureCompression = TextureImporterCompression.Uncompressed;
        TextureImporterPlatformSettings platform = importer.GetDefaultPlatformTextureSettings();
        platform.format = (TextureImporterFormat)@TEXTURE_FORMAT@;
        importer.SetPlatformTextureSettings(platform);
    }
}
#endif
)";

// Unity's v runs from the bottom row up, and an inline sampler of this name is bilinear and clamped.
constexpr const char* k_include_head = R"(#ifndef CUTICLE_HAIR_INCLUDED
#define CUTICLE_HAIR_INCLUDED
SamplerState sampler_linear_clamp;
@TEXTURES@#define CUTICLE_SAMPLE(table, uv) table.SampleLevel(sampler_linear_clamp, float2((uv).x, 1.0 - (uv).y), 0)
)";

constexpr const char* k_check =
    R"(// Written by cuticle @VERSION@. Green: every probe of the tables reads right. Red: one does not.
Shader "Cuticle/LUT check"
{
    Properties
    {
@PROPERTIES@    }
    SubShader
    {
        Pass
        {
            HLSLPROGRAM
            #pragma target 4.5
            #pragma vertex vertex
            #pragma fragment fragment
            #include "UnityCG.cginc"
            #include "CuticleHair.hlsl"
            float4 vertex(float4 position : POSITION) : SV_POSITION { return UnityObjectToClipPos(position); }
            float4 fragment() : SV_Target
            {
                return cuticle_verify_probes() == 0 ? float4(0, 1, 0, 1) : float4(1, 0, 0, 1);
            }
            ENDHLSL
        }
    }
}
)";

/// Unity's numbers: RGBAHalf 17, RGBA64 74, RGBA32 4.
std::string texture_format(const Manifest& manifest) {
  return manifest.format == "exr" ? "17" : manifest.format == "png16" ? "74" : "4";
}

/// Every asset has a GUID of 32 digits; the same table always has the same.
std::string guid(const ManifestTable& table) { return sha256_of("unity " + table.name + table.sha256).substr(0, 32); }

std::string lines(const Manifest& manifest, fmt::format_string<const std::string&> line) {
  std::string text;
  for (const ManifestTable& table : manifest.tables) text += fmt::format(line, table.name);
  return text;
}

Result<TextFile> include_file(const Manifest& manifest) {
  const std::pair<std::string_view, std::string> values[] = {{"TEXTURES", lines(manifest, "Texture2D cuticle_{};\n")}};
  CUTICLE_ASSIGN(const std::string text, engine_snippet(manifest, "hlsl", filled(k_include_head, values)));
  return TextFile{"CuticleHair.hlsl", text + "#endif\n"};
}

Result<std::vector<TextFile>> files(const Manifest& manifest) {
  CUTICLE_TRY(check_readable(manifest, "unity", k_readable));
  std::vector<TextFile> made;
  for (const ManifestTable& table : manifest.tables) {
    const std::pair<std::string_view, std::string> values[] = {{"GUID", guid(table)},
                                                               {"TEXTURE_FORMAT", texture_format(manifest)}};
    made.push_back({table.file + ".meta", filled(k_meta, values)});
  }
  const std::pair<std::string_view, std::string> values[] = {
      {"VERSION", manifest.tool_version},
      {"TEXTURE_FORMAT", texture_format(manifest)},
      {"MODEL", manifest.model},
      {"TABLES", names_of_tables(manifest)},
      {"PROPERTIES", lines(manifest, "        [NoScaleOffset] cuticle_{0} (\"{0}\", 2D) = \"black\" {{}}\n")}};
  made.push_back({"CuticleLutImporter.cs", filled(k_importer, values)});
  made.push_back({"CuticleLutCheck.shader", filled(k_check, values)});
  // Tables that do not make S shade nothing by themselves.
  if (!manifest.terms.empty()) made.push_back({"CuticleHairURP.shader", filled(urp_material(), values)});
  if (!manifest.terms.empty()) made.push_back({"CuticleHairHDRP.shader", filled(hdrp_material(), values)});
  made.push_back({"README.md", filled(k_readme, values)});
  CUTICLE_ASSIGN(made.emplace_back(), include_file(manifest));
  return made;
}

}  // namespace

const Target& entry() {
  static const Target target{"unity",
                             "a .meta a table, an importer, materials for URP and HDRP, CuticleHair.hlsl, a check", files};
  return target;
}

}  // namespace cuticle::lut::unity
