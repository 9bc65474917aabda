#include "lut/formats/png.h"

namespace cuticle::lut::png16 {

const Format& entry() {
  static const Format format = png_format<16>("png16", "PNG, 16 bit, no transfer curve");
  return format;
}

}  // namespace cuticle::lut::png16
