// What is drawn of the hair's maps: which opacity a channel has is of no matter here.
#define CHANNEL_CONSTANT 0
#include "render/channels.glsl"
layout(push_constant) uniform Push {
  uint vertices_per_strand;
  float width;  // factor on the radii
  uint segment_count, light_count;
  uint parts;                 // of a segment, which are drawn as one
  uint first_row, row_count;  // of the maps, which this dispatch draws
  float alpha[3];             // of one crossing: k_different of them
};
