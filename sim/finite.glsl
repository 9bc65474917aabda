// By bits: a compiler may assume that there is no NaN.
bool finite(vec3 v) { return all(lessThan(floatBitsToUint(v) & 0x7f800000u, uvec3(0x7f800000u))); }
