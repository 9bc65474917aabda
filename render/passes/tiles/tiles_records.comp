#version 460
#extension GL_GOOGLE_include_directive : require
#include "cuticle/render/passes/tiles/exchange_records.glsl"
#include "cuticle/render/passes/tiles/tiles_sorted.glsl"
