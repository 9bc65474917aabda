#ifndef CUTICLE_RENDER_MIXED_BITS_GLSL
#define CUTICLE_RENDER_MIXED_BITS_GLSL

// A bit mixer (multiply and shift), the same on every device.
uint mixed_bits(uint bits) {
  bits = (bits ^ (bits >> 15)) * 0x2C1B3C6Du;
  bits = (bits ^ (bits >> 12)) * 0x297A2D39u;
  return bits ^ (bits >> 15);
}

#endif
