#version 460
#extension GL_GOOGLE_include_directive : require
#define MARKS_SEEN
#include "render/passes/tiles/exchange_shared.glsl"
#include "render/passes/tiles/areas.glsl"
#include "render/passes/tiles/tiles_sorted.glsl"
