// What a pixel sees of the hair (Seen of pass_gpu.h, word for word).
struct Seen {
  uint first, last;  // vertices of the segment that most of the pixel sees; no hair where they are equal
  float coverage;    // share of the pixel that hair covers
  uint samples;      // segments or strands that the pixel's colour was made of
  uint cost;         // of which it was asked whether they cover it
};
