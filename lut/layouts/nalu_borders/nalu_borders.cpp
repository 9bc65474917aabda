#include <cuticle/lut/layouts/nalu_channels.h>

namespace cuticle::lut::nalu_borders {

const Layout& entry() {
  static const Layout layout{
      nalu_entry("nalu_borders", "as nalu, end points on texel borders: the sine or cosine itself addresses the table"),
      k_nalu_tables<false>, k_three_textures};
  return layout;
}

}  // namespace cuticle::lut::nalu_borders
