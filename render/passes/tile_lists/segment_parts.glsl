// A segment may have vertices between its ends, on one line, at which light is found: it is drawn whole, in so many parts.
#ifndef PARTS_CONSTANT
#define PARTS_CONSTANT 3
#endif
layout(constant_id = PARTS_CONSTANT) const uint k_parts = 1u;
