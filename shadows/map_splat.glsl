// Walks the texels that a strand segment covers. The shader that includes this defines deposit(), which is called for each.
#include "cuticle/shadows/map_segments.glsl"

void deposit(Footprint footprint, int i, int j);

void piece(Footprint footprint) {
  const Reach reach = footprint_reach(footprint);
  const int end = int(push.resolution) - 1;
  for (int m = max(0, reach.first); m <= min(end, reach.last); ++m) {
    const int last = min(end, minor_bound(footprint, reach, m, 1.0));
    for (int n = max(0, minor_bound(footprint, reach, m, -1.0)); n <= last; ++n)
      deposit(footprint, reach.steep ? n : m, reach.steep ? m : n);
  }
}
