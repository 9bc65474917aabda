#version 460
#extension GL_GOOGLE_include_directive : require
#define MARKS_SEEN
#include "render/passes/tiles/exchange_records.glsl"
#include "render/passes/tiles/spans.glsl"
#include "render/passes/tiles/tiles_sorted.glsl"
