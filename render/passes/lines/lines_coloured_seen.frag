#version 460
#extension GL_GOOGLE_include_directive : require
#define CHANNELS 3u
#define SAYS_SEEN
#include "render/passes/lines/lines_fragment.glsl"
