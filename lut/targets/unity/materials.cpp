#include "lut/targets/unity/materials.h"

namespace cuticle::lut::unity {

// Unity leaves out the 1 / pi of a diffuse surface, so that its light colours are irradiance / pi.
const char* const k_urp_material = R"shader(// Written by cuticle @VERSION@. Hair by the tables, for strips or cards whose mesh tangent runs from root to tip.
Shader "Cuticle/Hair (URP)"
{
    Properties
    {
@PROPERTIES@        _Ambient("Light from all around", Color) = (0.05, 0.05, 0.05, 1)
    }
    SubShader
    {
        Tags { "RenderPipeline" = "UniversalPipeline" "RenderType" = "Opaque" "Queue" = "Geometry" }
        Pass
        {
            Tags { "LightMode" = "UniversalForward" }
            Cull Off
            HLSLPROGRAM
            #pragma target 4.5
            #pragma vertex vertex
            #pragma fragment fragment
            #pragma multi_compile _ _MAIN_LIGHT_SHADOWS _MAIN_LIGHT_SHADOWS_CASCADE
            #pragma multi_compile _ _ADDITIONAL_LIGHTS
            #include "Packages/com.unity.render-pipelines.universal/ShaderLibrary/Core.hlsl"
            #include "Packages/com.unity.render-pipelines.universal/ShaderLibrary/Lighting.hlsl"
            #include "CuticleHair.hlsl"
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
            float3 scattered(Light light, float3 eye, float3 tangent)
            {
                float sine = dot(light.direction, tangent);
                float3 irradiance = PI * light.color * light.distanceAttenuation * light.shadowAttenuation;
                return cuticle_hair_scattering(light.direction, eye, tangent) * sqrt(saturate(1 - sine * sine)) * irradiance;
            }
            float4 fragment(Interpolated input) : SV_Target
            {
                float3 tangent = normalize(input.tangent), eye = GetWorldSpaceNormalizeViewDir(input.world);
                float3 color = _Ambient.rgb + scattered(GetMainLight(TransformWorldToShadowCoord(input.world)), eye, tangent);
            #ifdef _ADDITIONAL_LIGHTS
                for (uint i = 0; i < GetAdditionalLightsCount(); ++i)
                    color += scattered(GetAdditionalLight(i, input.world), eye, tangent);
            #endif
                return float4(color, 1);
            }
            ENDHLSL
        }
    }
}
)shader";

// Positions are relative to the camera; colours are multiplied by the exposure of the frame.
const char* const k_hdrp_material = R"shader(// Written by cuticle @VERSION@. Hair by the tables, for strips or cards whose mesh tangent runs from root to tip.
// Directional lights, without shadows.
Shader "Cuticle/Hair (HDRP)"
{
    Properties
    {
@PROPERTIES@        _Ambient("Light from all around", Color) = (0.05, 0.05, 0.05, 1)
    }
    SubShader
    {
        Tags { "RenderPipeline" = "HDRenderPipeline" "RenderType" = "HDLitShader" "Queue" = "Geometry" }
        Pass
        {
            Tags { "LightMode" = "ForwardOnly" }
            Cull Off
            HLSLPROGRAM
            #pragma target 4.5
            #pragma vertex vertex
            #pragma fragment fragment
            #include "Packages/com.unity.render-pipelines.core/ShaderLibrary/Common.hlsl"
            #include "Packages/com.unity.render-pipelines.high-definition/Runtime/ShaderLibrary/ShaderVariables.hlsl"
            #include "CuticleHair.hlsl"
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
            float4 fragment(Interpolated input) : SV_Target
            {
                float3 tangent = normalize(input.tangent), eye = GetWorldSpaceNormalizeViewDir(input.world);
                float3 color = _Ambient.rgb;
                for (uint i = 0; i < _DirectionalLightCount; ++i)
                {
                    float3 to_light = -_DirectionalLightDatas[i].forward;
                    float sine = dot(to_light, tangent);
                    color += cuticle_hair_scattering(to_light, eye, tangent) * sqrt(saturate(1 - sine * sine)) *
                             _DirectionalLightDatas[i].color;
                }
                return float4(color * GetCurrentExposureMultiplier(), 1);
            }
            ENDHLSL
        }
    }
}
)shader";

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
