// A row of a card as it rests (CardRest of placement_gpu.h) and as its strands carry it (PlacedRow).
struct CardRest {
  vec4 correction;        // middle of the row less the mean of the followers, metres; w: v, 0 at the root, 1 at the tip
  vec4 across;            // unit; w: half width, metres
  vec4 tangent;           // unit; w: ambient occlusion at u = 0
  vec4 follower_tangent;  // unit, of the followers' mean; w: ambient occlusion at u = 1
  uvec4 followers;        // first and end of the list; the card's kind
};
struct PlacedRow {
  vec4 left, right;  // u = 0 and u = 1: position, ambient occlusion
  vec4 normal, tangent;
};
