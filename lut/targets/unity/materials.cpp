#include "lut/targets/unity/materials.h"

#include "lut/target.h"

namespace cuticle::lut::unity {

namespace {

/// What one of Unity's render pipelines writes in its own way.
struct Pipeline {
  std::string name, note, tags, light_mode, includes, light, sum, exposure;
};

// Of both pipelines; between @ stand the members of Pipeline, @VERSION@ and @PROPERTIES@.
constexpr const char* k_material =
    R"shader(// Written by cuticle @VERSION@. Hair by the tables, for strips or cards whose mesh tangent runs from root to tip.
@NOTE@Shader "Cuticle/Hair (@PIPELINE@)"
{
    Properties
    {
@PROPERTIES@        _Ambient("Light from all around", Color) = (0.05, 0.05, 0.05, 1)
    }
    SubShader
    {
        Tags { @TAGS@ "Queue" = "Geometry" }
        Pass
        {
            Tags { "LightMode" = "@LIGHT_MODE@" }
            Cull Off
            HLSLPROGRAM
            #pragma target 4.5
            #pragma vertex vertex
            #pragma fragment fragment
@INCLUDES@            #include "CuticleHair.hlsl"
            float4 _Ambient;
            struct Input { float4 position : POSITION; float4 tangent : TANGENT; };
            struct Interpolated { float4 clip : SV_POSITION; float3 world : TEXCOORD0; float3 tangent : TEXCOORD1; };
            Interpolated vertex(Input input)
            {
                Interpolated result;
                result.world = TransformObjectToWorld(input.position.xyz);
                result.clip = TransformWorldToHClip(result.world);
                result.tangent = TransformObjectToWorldDir(input.tangent.xyz);
                return result;
            }
            float3 scattered(float3 to_light, float3 irradiance, float3 eye, float3 tangent)
            {
                float sine = dot(to_light, tangent);
                return cuticle_hair_scattering(to_light, eye, tangent) * sqrt(saturate(1 - sine * sine)) * irradiance;
            }
@LIGHT@            float4 fragment(Interpolated input) : SV_Target
            {
                float3 tangent = normalize(input.tangent), eye = GetWorldSpaceNormalizeViewDir(input.world);
                float3 color = _Ambient.rgb;
@SUM@                return float4(color@EXPOSURE@, 1);
            }
            ENDHLSL
        }
    }
}
)shader";

// The universal pipeline leaves out the 1 / pi of a diffuse surface, so that its light colours are irradiance / pi.
const Pipeline k_urp = {
    .name = "URP",
    .note = "",
    .tags = R"("RenderPipeline" = "UniversalPipeline" "RenderType" = "Opaque")",
    .light_mode = "UniversalForward",
    .includes = R"(            #pragma multi_compile _ _MAIN_LIGHT_SHADOWS _MAIN_LIGHT_SHADOWS_CASCADE
            #pragma multi_compile _ _ADDITIONAL_LIGHTS
            #include "Packages/com.unity.render-pipelines.universal/ShaderLibrary/Core.hlsl"
            #include "Packages/com.unity.render-pipelines.universal/ShaderLibrary/Lighting.hlsl"
)",
    .light = R"(            float3 scattered_of(Light light, float3 eye, float3 tangent)
            {
                float3 irradiance = PI * light.color * light.distanceAttenuation * light.shadowAttenuation;
                return scattered(light.direction, irradiance, eye, tangent);
            }
)",
    .sum =
        R"(                color += scattered_of(GetMainLight(TransformWorldToShadowCoord(input.world)), eye, tangent);
            #ifdef _ADDITIONAL_LIGHTS
                for (uint i = 0; i < GetAdditionalLightsCount(); ++i)
                    color += scattered_of(GetAdditionalLight(i, input.world), eye, tangent);
            #endif
)",
    .exposure = ""};

// In the high-definition pipeline positions are relative to the camera; colours are multiplied by the frame's exposure.
const Pipeline k_hdrp = {
    .name = "HDRP",
    .note = "// Directional lights, without shadows.\n",
    .tags = R"("RenderPipeline" = "HDRenderPipeline" "RenderType" = "HDLitShader")",
    .light_mode = "ForwardOnly",
    .includes = R"(            #include "Packages/com.unity.render-pipelines.core/ShaderLibrary/Common.hlsl"
            #include "Packages/com.unity.render-pipelines.high-definition/Runtime/ShaderLibrary/ShaderVariables.hlsl"
)",
    .light = "",
    .sum = R"(                for (uint i = 0; i < _DirectionalLightCount; ++i)
                    color += scattered(-_DirectionalLightDatas[i].forward, _DirectionalLightDatas[i].color, eye, tangent);
)",
    .exposure = " * GetCurrentExposureMultiplier()"};

std::string material_of(const Pipeline& pipeline) {
  const std::pair<std::string_view, std::string> values[] = {
      {"PIPELINE", pipeline.name},     {"NOTE", pipeline.note},
      {"TAGS", pipeline.tags},         {"LIGHT_MODE", pipeline.light_mode},
      {"INCLUDES", pipeline.includes}, {"LIGHT", pipeline.light},
      {"SUM", pipeline.sum},           {"EXPOSURE", pipeline.exposure}};
  return filled(k_material, values);
}

}  // namespace

std::string urp_material() { return material_of(k_urp); }
std::string hdrp_material() { return material_of(k_hdrp); }

const char* const k_readme = R"(# Hair tables for Unity

@TABLES@ of the model @MODEL@, written by cuticle @VERSION@.

1. Copy this folder into `Assets/`, with its `.meta` files. `CuticleLutImporter.cs` sets every table to linear, clamped,
   uncompressed and without mip maps, whatever the project's defaults are.
2. Make a material of the shader `Cuticle/Hair (URP)` or `Cuticle/Hair (HDRP)`, put each table into the slot of its name, and
   give the material to hair strips or cards whose tangents run from root to tip.
3. Put a material of `Cuticle/LUT check` with the same tables on any object: green says that every table reads right, red that
   one does not. `cuticle check lut FOLDER` names what an import did to the files.

`CuticleHair.hlsl` holds the functions for a shader of your own; the result is scattering without the cosine of the light's
inclination. These files follow Unity's documented names; nobody has opened them in the editor yet.
)";

}  // namespace cuticle::lut::unity
