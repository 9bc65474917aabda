#include "lut/formats/png.h"

namespace cuticle::lut::png8 {

const Format& entry() {
  static const Format format = png_format<8>("png8", "PNG, 8 bit, no transfer curve");
  return format;
}

}  // namespace cuticle::lut::png8
