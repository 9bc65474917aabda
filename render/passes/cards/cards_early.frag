#version 460
// A card's pixel where depth has said so beforehand: what is hidden is not shaded.
#extension GL_GOOGLE_include_directive : require
#include "render/passes/cards/cards_shade.glsl"

layout(early_fragment_tests) in;

void main() { color = shaded(texture(atlas_texture, uv_open.xy)); }
