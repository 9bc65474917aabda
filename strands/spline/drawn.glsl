// The drawn strands (drawn_gpu.h) as texels, of which a device reads more from one buffer than it allows a storage
// buffer. Before this: VERTICES_BINDING, TANGENTS_BINDING or both.
#ifdef VERTICES_BINDING
layout(set = 0, binding = VERTICES_BINDING) uniform samplerBuffer drawn_vertices;
vec4 drawn_vertex(uint vertex) { return texelFetch(drawn_vertices, int(vertex)); }  // position, radius
#endif
#ifdef TANGENTS_BINDING
layout(set = 0, binding = TANGENTS_BINDING) uniform samplerBuffer drawn_tangents;
vec4 drawn_tangent(uint vertex) { return texelFetch(drawn_tangents, int(vertex)); }  // unit tangent, fraction of the length
#endif
