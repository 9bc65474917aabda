#version 460
#extension GL_GOOGLE_include_directive : require
#define CHANNELS 1u
#include "render/passes/lines/lines_vertex.glsl"
