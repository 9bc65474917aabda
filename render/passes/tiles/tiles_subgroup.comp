#version 460
#extension GL_GOOGLE_include_directive : require
#include "cuticle/render/passes/tiles/exchange_subgroup.glsl"
#include "cuticle/render/passes/tiles/tiles_sorted.glsl"
