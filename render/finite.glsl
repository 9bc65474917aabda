// Not by isnan: shaders may be compiled as if numbers were always finite.
bool is_finite(vec4 v) { return all(notEqual(floatBitsToUint(v) & 0x7F800000u, uvec4(0x7F800000u))); }
