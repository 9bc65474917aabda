#include "lut/format.h"
#include "lut/formats/half.h"

namespace cuticle::lut {
namespace exr {
namespace {

Result<void> write(const std::string& path, const Image& image, const std::string& manifest) {
  return write_exr(path, image, ExrType::half, {{"cuticle:manifest", manifest}});
}

}  // namespace

const Format& entry() {
  static const Format format{"exr",    "exr",     "OpenEXR, half, ZIP", k_largest_half, false, 0, nearest_half, write,
                             read_exr, mip_levels};
  return format;
}

}  // namespace exr

const Format& half_exr() { return exr::entry(); }

}  // namespace cuticle::lut
