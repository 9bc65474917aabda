#version 460
// Into the visibility buffer: which segment a sample sees.
layout(location = 0) flat in uint segment;
layout(location = 0) out uint seen;

void main() { seen = segment; }
