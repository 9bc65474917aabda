// Push constants of the opacity map's kernels: class OpacityMapGpu's Push, word for word.
#include "cuticle/core/shared/lang.glslh"

layout(push_constant) uniform Push {
  vec4 axis_x, axis_y, axis_z;   // axis and offset: world to map (Geometry)
  float texels_per_metre;
  float filter_texels;
  float per_unit;                // -k / scale
  uint resolution, layers;
  uint count;                    // of segments, texels or vertices
  uint poisson;
} push;

/// Invocation number of a dispatch that is split over two axes.
uint invocation() {
  return (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
}
