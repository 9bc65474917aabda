#ifndef CUTICLE_GPU_GROUPS_GLSL
#define CUTICLE_GPU_GROUPS_GLSL
/// The number of this thread in a dispatch of groups_for (gpu/groups.h), whose groups of 64 may be spread over two axes.
uint invocation() { return gl_GlobalInvocationID.y * gl_NumWorkGroups.x * 64u + gl_GlobalInvocationID.x; }
#endif
